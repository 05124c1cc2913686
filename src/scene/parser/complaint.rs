//! The errors that say what was found where something else was expected.

use super::keyword::{KEYWORDS, Keyword};
use super::parameter::Declaration;
use super::source::Source;
use super::statement::{Span, Values};
use super::token::{Token, is_text, shorten};
use crate::error::Error;
use crate::scene::spelling;

impl<'a> Source<'a> {
    /// "found this where that is expected", at what `input` begins with.
    fn found(&self, input: &[u8], expected: &str) -> Error {
        let (token, at) = Token::next(input);
        let message = format!("found {} where {expected} is expected", token.describe());
        self.error(self.first(at, token.length()), message)
    }

    /// "before this", at what `input` begins with.
    fn before(&self, input: &[u8]) -> String {
        match Token::next(input) {
            (Token::End, _) => String::from("before the end of the file"),
            (token, at) => format!("before {} at {}", token.describe(), self.place(at)),
        }
    }

    fn keyword_span(&self, keyword: Keyword) -> Span {
        self.first(keyword.at, keyword.name.len())
    }

    /// `keyword` takes `needed` numbers, and after `count` of them comes something else.
    pub(super) fn too_few(
        &self,
        keyword: Keyword,
        needed: usize,
        count: usize,
        input: &[u8],
    ) -> Error {
        let name = keyword.name;
        let takes = format!("`{name}` takes {needed} numbers");
        match Token::next(input).0 {
            Token::End | Token::Keyword(_) | Token::Close => {
                let message = format!("`{name}` needs {needed} numbers, but {}", follow(count));
                let note = format!("expected a number {}", self.before(input));
                self.error(self.keyword_span(keyword), message).note(note)
            }
            _ => self.found(input, "a number").note(takes),
        }
    }

    /// After the numbers that `keyword` takes comes one more.
    pub(super) fn too_many(&self, keyword: Keyword, needed: usize, input: &[u8]) -> Error {
        let name = keyword.name;
        let (token, at) = Token::next(input);
        let message = format!("{} is one argument too many for `{name}`", token.describe());
        self.error(self.first(at, token.length()), message)
            .note(format!("`{name}` takes {needed} numbers"))
    }

    /// Something else than the `argument` that `keyword` takes comes next.
    pub(super) fn no_argument(&self, keyword: Keyword, argument: &str, input: &[u8]) -> Error {
        match Token::next(input).0 {
            Token::End | Token::Keyword(_) => {
                let message = format!("`{}` needs {argument}", keyword.name);
                let note = format!("expected it {}", self.before(input));
                self.error(self.keyword_span(keyword), message).note(note)
            }
            _ => self.found(input, argument),
        }
    }

    /// Something else than the string that `keyword` takes comes next.
    pub(super) fn no_string(&self, keyword: Keyword, input: &[u8]) -> Error {
        in_quotes(
            self.no_argument(keyword, "a string in quotes", input),
            Token::next(input).0,
        )
    }

    /// The string at `input` should have been closed on its line.
    pub(super) fn unclosed_string(&self, input: &[u8]) -> Error {
        let error = self.error(self.first(input, 1), "this string is not closed");
        error.note("a string ends with `\"` on the line where it begins")
    }

    /// The bracket at `open` should have been closed before `input`.
    pub(super) fn unclosed(&self, open: &[u8], input: &[u8]) -> Error {
        let note = format!("expected `]` {}", self.before(input));
        self.error(self.first(open, 1), "this `[` is not closed")
            .note(note)
    }

    /// In the array that begins at `open`, `input` follows `values`.
    pub(super) fn not_in_array(&self, open: &[u8], values: &Values, input: &[u8]) -> Error {
        let (token, at) = Token::next(input);
        let (kind, one) = match values {
            Values::Numbers(_) => ("an array of numbers", "a number"),
            Values::Strings(_) => ("an array of strings", "a string in quotes"),
            Values::Booleans(_) => ("an array of booleans", "`true` or `false`"),
            Values::None => ("an array", "a value"),
        };
        match token {
            Token::End | Token::Keyword(_) => return self.unclosed(open, input),
            Token::Quoted(inside) if Declaration::is_like(inside) => {
                return self.unclosed(open, input);
            }
            Token::Word(_) => return in_quotes(self.found(input, one), token),
            _ => {}
        }
        let message = format!("found {} in {kind}", token.describe());
        let note = format!(
            "the array begins at {}: is its `]` missing?",
            self.place(open)
        );
        self.error(self.first(at, token.length()), message)
            .note(note)
    }

    /// What follows `declared` is no value.
    pub(super) fn no_value(&self, declared: &Declaration, input: &[u8]) -> Error {
        let token = Token::next(input).0;
        match token {
            Token::End | Token::Keyword(_) | Token::Quoted(_) => {
                let message = format!(
                    "the parameter `{}` has no value",
                    shorten(declared.name.as_bytes())
                );
                self.error(declared.span.clone(), message)
                    .note(format!("expected a value {}", self.before(input)))
            }
            _ => in_quotes(self.found(input, "a value"), token),
        }
    }

    /// After a parameter comes another value.
    pub(super) fn second_value(&self, declared: &Declaration, input: &[u8]) -> Error {
        let error = self.found(input, "a parameter or a directive");
        let declaration = format!("{} {}", declared.type_name, declared.name);
        error.note(format!(
            "several values need brackets: `\"{}\" [...]`",
            shorten(declaration.as_bytes())
        ))
    }

    /// The declaration of a parameter is not a type and a name.
    pub(super) fn half_declaration(&self, span: Span, word: &str) -> Error {
        let advice = "expected a type and a name, such as \"float radius\" or \"point3 P\"";
        let message = match word {
            "" => String::from("this string declares no parameter"),
            word => format!("the parameter \"{}\" has no type", shorten(word.as_bytes())),
        };
        self.error(span, message).note(advice)
    }

    /// No directive comes next; the one before it was `previous`.
    pub(super) fn no_directive(&self, previous: Option<&str>, input: &[u8]) -> Error {
        let (token, at) = Token::next(input);
        match token {
            Token::Word(word) if is_text(word) && !looks_numeric(word) => {
                self.unknown_directive(word, at)
            }
            Token::Quoted(_) if token.length() == 1 => self.unclosed_string(at),
            Token::Close => {
                let error = self.error(self.first(at, 1), "this `]` closes nothing");
                error.note("there is no `[` that is still open before it")
            }
            _ => {
                let error = self.found(input, "a directive");
                match previous {
                    Some(name) => error.note(format!("`{name}` before it takes no more arguments")),
                    None => {
                        error.note("a scene begins with a directive such as `LookAt` or `Camera`")
                    }
                }
            }
        }
    }

    fn unknown_directive(&self, word: &[u8], at: &[u8]) -> Error {
        let shown = shorten(word);
        let error = self.error(
            self.first(at, word.len()),
            format!("unknown directive `{shown}`"),
        );
        match spelling::closest(&String::from_utf8_lossy(word), KEYWORDS.into_iter()) {
            Some(keyword) => error.note(format!("did you mean `{keyword}`?")),
            None => error.note("expected a directive such as `Shape` or `Translate`"),
        }
    }
}

/// How many numbers follow a keyword that needs more.
fn follow(count: usize) -> String {
    match count {
        0 => String::from("none follows"),
        1 => String::from("only 1 follows"),
        count => format!("only {count} follow"),
    }
}

/// Whether whoever typed `word` seems to have meant a number.
fn looks_numeric(word: &[u8]) -> bool {
    let digits = word
        .strip_prefix(b"-")
        .or(word.strip_prefix(b"+"))
        .unwrap_or(word);
    let digits = digits.strip_prefix(b".").unwrap_or(digits);
    digits.first().is_some_and(u8::is_ascii_digit)
}

/// `error`, with advice on the bare word that it is about.
fn in_quotes(error: Error, token: Token) -> Error {
    let Token::Word(word) = token else {
        return error;
    };
    let shown = shorten(word);
    match word.to_ascii_lowercase().as_slice() {
        lower @ (b"true" | b"false") if word != lower => {
            error.note(format!("booleans are written `{}`", shown.to_lowercase()))
        }
        _ if looks_numeric(word) => error.note(format!("`{shown}` is not a number")),
        b"true" | b"false" => error,
        _ if is_text(word) => error.note(format!("a string needs quotes: \"{shown}\"")),
        _ => error,
    }
}
