//! Wrong text, and the messages about it in one line with notes.

pub(super) const BRIEF: &[(&str, &str)] = &[
    (
        "Translate",
        "1:1: `Translate` needs 3 numbers, but none follows\n   = expected a number before the end of the file",
    ),
    (
        "Transform [1 0]",
        "1:1: `Transform` needs 16 numbers, but only 2 follow\n   = expected a number before `]` at line 1, column 15",
    ),
    (
        "Scale [1 1 1",
        "1:7: this `[` is not closed\n   = expected `]` before the end of the file",
    ),
    (
        "Scale [1 1 1 1]",
        "1:14: the number `1` is one argument too many for `Scale`\n   = `Scale` takes 3 numbers",
    ),
    (
        "Scale 1, x, 1",
        "1:10: found `x` where a number is expected\n   = `Scale` takes 3 numbers",
    ),
    (
        "Scale 1 1 1 , ,1",
        "1:16: the number `1` is one argument too many for `Scale`\n   = `Scale` takes 3 numbers",
    ),
    (
        "\"abc",
        "1:1: this string is not closed\n   = a string ends with `\"` on the line where it begins",
    ),
    (
        "Scale 1 1.2.3 1",
        "1:9: found `1.2.3` where a number is expected\n   = `Scale` takes 3 numbers",
    ),
    (
        "Shape\nWorldEnd",
        "1:1: `Shape` needs a string in quotes\n   = expected it before `WorldEnd` at line 2, column 1",
    ),
    (
        "Shape sphere",
        "1:7: found `sphere` where a string in quotes is expected\n   = a string needs quotes: \"sphere\"",
    ),
    (
        "Shape \"s\" \"float r\"",
        "1:11: the parameter `r` has no value\n   = expected a value before the end of the file",
    ),
    (
        "Shape \"s\" \"float r\" \"float z\" 1",
        "1:11: the parameter `r` has no value\n   = expected a value before the string \"float z\" at line 1, column 21",
    ),
    (
        "Shape \"s\" \"string f\" foo",
        "1:22: found `foo` where a value is expected\n   = a string needs quotes: \"foo\"",
    ),
    (
        "Shape \"s\" \"bool b\" True",
        "1:20: found `True` where a value is expected\n   = booleans are written `true`",
    ),
    (
        "Shape \"s\" \"bool b\" [\"yes\"]",
        "1:21: found the string \"yes\" where a boolean is expected\n   = expected `true` or `false`",
    ),
    (
        "Shape \"s\" \"float r\" 0x10",
        "1:21: found `0x10` where a value is expected\n   = `0x10` is not a number",
    ),
    (
        "Shape \"s\" \"float r\" ]",
        "1:21: found `]` where a value is expected",
    ),
    (
        "Shape \"s\" \"float r\" [[1]]",
        "1:22: found `[` in an array\n   = the array begins at line 1, column 21: is its `]` missing?",
    ),
    (
        "Shape \"s\" \"float r\" [1 true]",
        "1:24: found `true` where a number is expected",
    ),
    (
        "Shape \"s\" \"string s\" [\"a\" 1]",
        "1:27: found the number `1` in an array of strings\n   = the array begins at line 1, column 22: is its `]` missing?",
    ),
    (
        "Shape \"s\" \"float r\" [1 \"float z\" 2",
        "1:21: this `[` is not closed\n   = expected `]` before the string \"float z\" at line 1, column 24",
    ),
    (
        "Material \"m\" \"rgb Kd\" [1 \"b\"]",
        "1:26: found the string \"b\" in an array of numbers\n   = the array begins at line 1, column 23: is its `]` missing?",
    ),
    (
        "Shape \"s\" \"\" 1",
        "1:11: this string declares no parameter\n   = expected a type and a name, such as \"float radius\" or \"point3 P\"",
    ),
    (
        "AttributeBegin 3",
        "1:16: found the number `3` where a directive is expected\n   = `AttributeBegin` before it takes no more arguments",
    ),
    (
        "Include \"a\" \"b\"",
        "1:13: found the string \"b\" where a directive is expected\n   = `Include` before it takes no more arguments",
    ),
    (
        "12",
        "1:1: found the number `12` where a directive is expected\n   = a scene begins with a directive such as `LookAt` or `Camera`",
    ),
    (
        "foo",
        "1:1: unknown directive `foo`\n   = expected a directive such as `Shape` or `Translate`",
    ),
    (
        "Foo [ 1 [ 2 ] \"a\"",
        "1:5: this `[` is not closed\n   = expected `]` before the end of the file",
    ),
    (
        "Foo [ 1 Shape",
        "1:5: this `[` is not closed\n   = expected `]` before `Shape` at line 1, column 9",
    ),
    (
        "Foo \"a",
        "1:5: this string is not closed\n   = a string ends with `\"` on the line where it begins",
    ),
    (
        "Foo 1 ]",
        "1:7: this `]` closes nothing\n   = there is no `[` that is still open before it",
    ),
    (
        "Foo bar",
        "1:5: unknown directive `bar`\n   = expected a directive such as `Shape` or `Translate`",
    ),
    (
        "Shapes \"sphere\"",
        "1:1: unknown directive `Shapes`\n   = did you mean `Shape`?",
    ),
    (
        "Include \"a\\d.pbrt\"",
        "1:11: unknown escape `\\d` in a string\n   = write `\\\\` for a backslash; paths take `/` on every system",
    ),
    (
        "ActiveTransform Allx",
        "1:17: found `Allx` where `StartTime`, `EndTime` or `All` is expected",
    ),
    (
        "ActiveTransform",
        "1:1: `ActiveTransform` needs `StartTime`, `EndTime` or `All`\n   = expected it before the end of the file",
    ),
];
