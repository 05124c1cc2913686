//! Directives that no pbrt knows: forks have some of their own.

use super::keyword::KEYWORDS;
use super::source::{Parsed, Source, wrong};
use super::statement::{Directive, Statement};
use super::token::{Token, word};
use crate::scene::spelling;

/// The name of a directive, if `word` looks like one: a capital letter, then letters, digits and `_`.
fn name_of(word: &[u8]) -> Option<&str> {
    let (first, others) = word.split_first()?;
    let looks_so = first.is_ascii_uppercase()
        && others
            .iter()
            .all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    if looks_so {
        std::str::from_utf8(word).ok()
    } else {
        None
    }
}

impl<'a> Source<'a> {
    /// An unknown directive, to be skipped. A misspelt known one is an error: geometry might be lost with it.
    pub(super) fn private(
        &self,
        previous: Option<&str>,
        input: &'a [u8],
    ) -> Parsed<'a, (&'a str, Directive<'a>)> {
        let named = word(input)
            .ok()
            .and_then(|(rest, word)| Some((rest, name_of(word)?)));
        match named {
            Some((rest, name)) if spelling::closest(name, KEYWORDS.into_iter()).is_none() => {
                let keyword = self.span(input, rest);
                let (rest, ()) = self.arguments(rest)?;
                let (span, statement) = (self.span(input, rest), Statement::Private(name));
                Ok((
                    rest,
                    (
                        name,
                        Directive {
                            span,
                            keyword,
                            keyword_number: None,
                            statement,
                        },
                    ),
                ))
            }
            _ => wrong(self.no_directive(previous, input)),
        }
    }

    /// Strings, numbers, booleans and brackets with such in them, as many as there are.
    fn arguments(&self, input: &'a [u8]) -> Parsed<'a, ()> {
        let mut end = input;
        let mut open: Vec<&[u8]> = Vec::new();
        loop {
            let (token, at) = Token::next(end);
            match token {
                Token::Quoted(_) => end = self.text(at)?.0,
                Token::Open => open.push(at),
                Token::Close if !open.is_empty() => _ = open.pop(),
                Token::Number(_) | Token::Word(b"true" | b"false") => {}
                Token::Comma if !open.is_empty() => {}
                _ => match open.last() {
                    Some(bracket) => return wrong(self.unclosed(bracket, at)),
                    None => return Ok((end, ())),
                },
            }
            if !matches!(token, Token::Quoted(_)) {
                end = &at[token.length()..];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::name_of;

    #[test]
    fn names_begin_with_a_capital_letter() {
        for name in ["A", "Mesh", "RenderPass_2", "USDStage"] {
            assert_eq!(name_of(name.as_bytes()), Some(name));
        }
        for word in [
            "",
            "mesh",
            "_Mesh",
            "2Mesh",
            "Me-sh",
            "Mesh:",
            "\u{c4}rger",
            "Gr\u{fc}n",
        ] {
            assert_eq!(name_of(word.as_bytes()), None, "{word}");
        }
    }
}
