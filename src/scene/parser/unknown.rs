//! Directives that no version of pbrt knows.

use super::diagnostics::Diagnostics;
use super::directive::{Directive, KEYWORDS};
use super::lexer::{Parsed, Token, word, wrong};
use super::statement::Statement;
use super::values::text;
use crate::scene::spelling;

/// A directive that no version of pbrt knows, with its arguments: forks have some of their own.
///
/// A misspelt known one is an error: geometry might be lost with it.
pub(super) fn unknown_directive<'a>(
    errors: Diagnostics,
    previous: Option<&str>,
    input: &'a [u8],
) -> Parsed<'a, (&'a str, Directive<'a>)> {
    let named = word(input)
        .ok()
        .and_then(|(rest, word)| Some((rest, directive_name(word)?)));
    let Some((after, name)) =
        named.filter(|(_, name)| spelling::closest(name, KEYWORDS.into_iter()).is_none())
    else {
        return wrong(errors.no_directive(previous, input));
    };
    let (rest, ()) = any_arguments(errors, after)?;
    let directive = Directive {
        span: errors.span(input, rest),
        keyword: errors.span(input, after),
        description: None,
        statement: Statement::Unknown(name),
    };
    Ok((rest, (name, directive)))
}

/// `word` if it looks like a directive: a capital letter, then letters, digits and `_`.
fn directive_name(word: &[u8]) -> Option<&str> {
    let (first, others) = word.split_first()?;
    let is_in_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    if !first.is_ascii_uppercase() || !others.iter().all(is_in_name) {
        return None;
    }
    std::str::from_utf8(word).ok()
}

/// Strings, numbers, booleans and nested brackets of them, up to anything else.
fn any_arguments<'a>(errors: Diagnostics, input: &'a [u8]) -> Parsed<'a, ()> {
    let mut end = input;
    let mut open: Vec<&[u8]> = Vec::new();
    loop {
        let (token, at) = Token::next(end);
        match token {
            Token::Quoted(_) => end = text(errors, at)?.0,
            Token::Open => open.push(at),
            Token::Close if !open.is_empty() => _ = open.pop(),
            Token::Number(_) | Token::Word(b"true" | b"false") => {}
            Token::Comma if !open.is_empty() => {}
            _ => match open.last() {
                Some(bracket) => return wrong(errors.unclosed(bracket, at)),
                None => return Ok((end, ())),
            },
        }
        if !matches!(token, Token::Quoted(_)) {
            end = &at[token.length()..];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::directive_name;

    #[test]
    fn directive_names_begin_with_a_capital_letter() {
        for name in ["A", "Mesh", "RenderPass_2", "USDStage"] {
            assert_eq!(directive_name(name.as_bytes()), Some(name));
        }
        let others = [
            "",
            "mesh",
            "_Mesh",
            "2Mesh",
            "Me-sh",
            "Mesh:",
            "\u{c4}rger",
            "Gr\u{fc}n",
        ];
        for word in others {
            assert_eq!(directive_name(word.as_bytes()), None, "{word}");
        }
    }
}
