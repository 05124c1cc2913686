//! Blanks, comments, strings and numbers as they are found in files.

use super::super::{Statement as S, TransformDirective as T, Values};
use super::{parameters, parse, statement, statements, values};

#[test]
fn an_empty_file_has_no_directives() {
    for source in [
        "",
        " \t\r\n",
        "# only a comment",
        "\u{feff}",
        "\u{feff}# comment\r\n",
    ] {
        assert_eq!(statements(source), []);
    }
}

#[test]
fn blanks_and_comments_stand_anywhere() {
    let expected = S::Transform(T::Translate([1., 2., 3.]));
    for source in [
        "Translate 1 2 3",
        "\u{feff}Translate\r\n1\t2\r3\r\n",
        "Translate#c\n1#c \"[\n2 # c\n3#c",
        "# a\r# b\r\nTranslate[1#c]\n2\n3]# end",
        "Translate [1,2, 3]",
    ] {
        assert_eq!(statement(source), expected, "{source:?}");
    }
    assert_eq!(
        values("\"point2 p\" [1 # one ]\r\n 2 # two\n]"),
        Values::Numbers(vec![1., 2.])
    );
}

#[test]
fn a_comment_does_not_begin_in_a_string() {
    let S::Include(text) = statement("Include \"a#b\"#c") else {
        panic!("no Include")
    };
    assert_eq!(text.text, "a#b");
}

#[test]
fn numbers_of_every_spelling() {
    let Values::Numbers(numbers) =
        values("\"float f\" [.5 5. +1 -0 1e-3 1E+3 -1e999 1e-999 inf -INF Infinity]")
    else {
        panic!("no numbers");
    };
    let infinite = f64::INFINITY;
    assert_eq!(
        numbers,
        [
            0.5, 5., 1., 0., 1e-3, 1e3, -infinite, 0., infinite, -infinite, infinite
        ]
    );
    assert!(numbers[3].is_sign_negative());
    assert!(
        matches!(values("\"float f\" -NaN"), Values::Numbers(n) if n.len() == 1 && n[0].is_nan())
    );
}

#[test]
fn tokens_need_no_blank_between_them() {
    let shape =
        parameters("Shape\"s\"\"float r\"1\"point P\"[0 0 0]\"bool b\"true\"string s\"\"t\"");
    assert_eq!(shape.len(), 4);
}

#[test]
fn declarations_may_have_more_blanks() {
    for declaration in [
        "\"float fov\"",
        "\" float\tfov \"",
        "\"float   fov\t\"",
        "\"float\\tfov\"",
        "\"float fov more\"",
    ] {
        let source = format!("Shape \"s\" {declaration} 45");
        let parameter = parameters(&source).remove(0);
        assert_eq!(
            (&*parameter.type_name, &*parameter.name),
            ("float", "fov"),
            "{declaration}"
        );
    }
}

#[test]
fn escapes_are_undone() {
    let S::Include(text) = statement(r#"Include "a\\b\"c\'\n\t\r\b\f""#) else {
        panic!("no Include")
    };
    assert_eq!(text.text, "a\\b\"c'\n\t\r\u{8}\u{c}");
}

#[test]
fn strings_need_not_be_utf8() {
    let directives = parse(b"Include \"\xff.pbrt\"\nInclude \"\xff\\n\"").expect("directives");
    let texts: Vec<&str> = directives
        .iter()
        .map(|directive| match &directive.statement {
            S::Include(text) => &*text.text,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(texts, ["\u{fffd}.pbrt", "\u{fffd}\n"]);
}
