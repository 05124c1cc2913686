//! Paths that a source file names outside of its tests.

/// One path, as segments, and the name that a `use` gives it.
#[derive(Debug, PartialEq)]
pub(crate) struct Import {
    pub(crate) path: Vec<String>,
    pub(crate) name: String,
    pub(crate) kind: Kind,
}

/// How a path is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// By a `use` for the module itself.
    Use,
    /// By a `pub use`, for others.
    PublicUse,
    /// In an expression or a type.
    Direct,
}

/// The text without comments, strings, characters, and items for tests.
pub(crate) fn code_of(text: &str) -> String {
    without_tests(&without_comments_and_strings(text))
}

fn without_comments_and_strings(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let skipped = match first {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '"' => string_length(rest),
            'r' if rest.starts_with("r\"") || rest.starts_with("r#") => raw_string_length(rest),
            '\'' => character_length(rest),
            _ => 0,
        };
        match skipped {
            0 => code.push(first),
            _ => code.push(' '),
        }
        rest = &rest[skipped.max(first.len_utf8())..];
    }
    code
}

fn string_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let mut end = 1;
    while bytes[end] != b'"' {
        end += if bytes[end] == b'\\' { 2 } else { 1 };
    }
    end + 1
}

/// Zero for a raw identifier.
fn raw_string_length(text: &str) -> usize {
    let hashes = text[1..].bytes().take_while(|byte| *byte == b'#').count();
    if text.as_bytes().get(1 + hashes) != Some(&b'"') {
        return 0;
    }
    let end = format!("\"{}", "#".repeat(hashes));
    2 + hashes + text[2 + hashes..].find(&end).expect("a raw string ends") + end.len()
}

/// Zero for a lifetime.
fn character_length(text: &str) -> usize {
    let mut characters = text.char_indices().skip(1);
    match (characters.next(), characters.next()) {
        (Some((_, '\\')), _) => 2 + text[2..].find('\'').map_or(0, |end| end.max(1) + 1),
        (Some(_), Some((end, '\''))) => end + 1,
        _ => 0,
    }
}

/// Drops each item behind `#[cfg(test)]` or `#[cfg(all(test, ...))]`.
fn without_tests(code: &str) -> String {
    let mut kept = String::new();
    let mut rest = code;
    while let Some(start) = ["#[cfg(test)]", "#[cfg(all(test"]
        .iter()
        .filter_map(|mark| rest.find(mark))
        .min()
    {
        kept += &rest[..start];
        let item = &rest[start..];
        let end = item.find([';', '{']).expect("an item has an end");
        rest = match item.as_bytes()[end] {
            b';' => &item[end + 1..],
            _ => &item[end + block_length(&item[end..])..],
        };
    }
    kept + rest
}

/// The length of a block, from its opening brace to behind its closing one.
fn block_length(code: &str) -> usize {
    let mut depth = 0;
    for (at, character) in code.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => continue,
        }
        if depth == 0 {
            return at + 1;
        }
    }
    code.len()
}

/// All paths of `code`, those of `use` and those in between.
pub(crate) fn imports_of(code: &str) -> Vec<Import> {
    let mut imports = Vec::new();
    let mut rest = code;
    while let Some(start) = rest.find("use ") {
        let is_word = rest[..start]
            .chars()
            .next_back()
            .is_none_or(|c| !c.is_alphanumeric() && c != '_');
        let (before, tree) = (&rest[..start], &rest[start + 4..]);
        paths_in(before, &mut imports);
        let end = if is_word {
            tree.find(';').expect("a use ends")
        } else {
            0
        };
        let is_public = before.ends_with("pub ") || before.ends_with(") ");
        let kind = if is_public {
            Kind::PublicUse
        } else {
            Kind::Use
        };
        add_tree(&[], &tree[..end], kind, &mut imports);
        rest = &tree[end..];
    }
    paths_in(rest, &mut imports);
    imports
}

/// Adds the paths of a `use` tree such as `a::{b, c::d as e}`.
fn add_tree(prefix: &[String], tree: &str, kind: Kind, imports: &mut Vec<Import>) {
    let tree = tree.trim();
    if tree.is_empty() {
        return;
    }
    let (head, branches) = match tree.split_once('{') {
        Some((head, rest)) => (head, Some(rest.strip_suffix('}').expect("a closing brace"))),
        None => (tree, None),
    };
    let (head, alias) = match head.split_once(" as ") {
        Some((head, alias)) => (head, Some(alias.trim().to_owned())),
        None => (head, None),
    };
    let segments = head
        .split("::")
        .map(str::trim)
        .filter(|segment| !segment.is_empty());
    let path: Vec<String> = prefix
        .iter()
        .cloned()
        .chain(segments.map(str::to_owned))
        .collect();
    match branches {
        Some(branches) => split_branches(branches)
            .iter()
            .for_each(|branch| add_tree(&path, branch, kind, imports)),
        None => {
            let path: Vec<String> = path
                .into_iter()
                .filter(|segment| segment != "self" || prefix.is_empty())
                .collect();
            let name = alias.unwrap_or_else(|| path.last().expect("a path").clone());
            imports.push(Import { path, name, kind });
        }
    }
}

/// Splits at the commas that stand in no braces.
fn split_branches(branches: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, character) in branches.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&branches[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&branches[start..]);
    parts
}

/// Adds the paths and words that code names without a `use`: `crate::a::b`, `super::c::D`, `E`.
fn paths_in(code: &str, imports: &mut Vec<Import>) {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words: Vec<&str> = code
        .split(|c| !is_part(c))
        .filter(|word| !word.is_empty())
        .collect();
    // A declaration `mod name;` and a visibility `pub(in path)` need nothing of the module.
    let is_declared = |at: usize| matches!(words[..at], [.., "mod"] | [.., "pub", "in"]);
    for (_, word) in words.iter().enumerate().filter(|(at, _)| !is_declared(*at)) {
        let path: Vec<String> = word
            .split("::")
            .filter(|part| !part.is_empty())
            .map(str::to_owned)
            .collect();
        let is_visibility =
            matches!(path.as_slice(), [one] if ["crate", "self", "super"].contains(&one.as_str()));
        if !path.is_empty() && !is_visibility && !word.starts_with("::") {
            let name = path[0].clone();
            imports.push(Import {
                path,
                name,
                kind: Kind::Direct,
            });
        }
    }
}

#[test]
fn imports_are_read() {
    let code = code_of(
        "use a::{self, b::C as D, e};\n// use f::g;\nfn h() { super::i(\"use j;\"); k('\"'); }\n\
         #[cfg(test)]\nmod tests { use l::m; }\npub use n::o;",
    );
    let imports = imports_of(&code);
    let paths = imports
        .iter()
        .filter(|import| import.kind != Kind::Direct || import.path.len() > 1);
    let found: Vec<String> = paths.map(|import| import.path.join("::")).collect();
    assert_eq!(found, ["a", "a::b::C", "a::e", "super::i", "n::o"]);
}
