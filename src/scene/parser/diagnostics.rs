//! The parser's error messages: what was found, where, and what was expected.

use super::directive::KEYWORDS;
use super::lexer::{Token, is_text, shorten};
use super::statement::{Declaration, Values};
use crate::error::{Error, Position};
use crate::scene::source_file::{SourceFile, Span};
use crate::scene::spelling;

/// Makes errors about one file. A position in it is a suffix of its text, whose length tells where
/// it begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Diagnostics<'a> {
    file: &'a SourceFile,
}

/// A keyword in the text, for messages about its arguments.
#[derive(Debug, Clone, Copy)]
pub(super) struct Keyword<'a> {
    pub(super) name: &'static str,
    /// The text from the keyword on.
    pub(super) at: &'a [u8],
}

impl<'a> Diagnostics<'a> {
    pub(super) fn new(file: &'a SourceFile) -> Diagnostics<'a> {
        Diagnostics { file }
    }

    /// The bytes from `from` to `to`, both suffixes of the text.
    pub(super) fn span(&self, from: &[u8], to: &[u8]) -> Span {
        let end = self.file.end();
        end - from.len()..end - to.len()
    }

    /// The first `length` bytes of the suffix `rest`.
    fn first(&self, rest: &[u8], length: usize) -> Span {
        let start = self.file.end() - rest.len();
        start..start + length
    }

    /// An error about the first `length` bytes of the suffix `rest`.
    fn error(&self, rest: &[u8], length: usize, message: impl Into<String>) -> Error {
        self.file.error(&self.first(rest, length), message)
    }

    fn keyword_error(&self, keyword: Keyword, message: String) -> Error {
        self.error(keyword.at, keyword.name.len(), message)
    }

    /// "found this where that is expected".
    fn found(&self, input: &[u8], expected: &str) -> Error {
        let (token, at) = Token::next(input);
        let message = format!("found {} where {expected} is expected", token.describe());
        self.error(at, token.length(), message)
    }

    /// "before this at line 1, column 2".
    fn before(&self, input: &[u8]) -> String {
        let (token, at) = Token::next(input);
        match token {
            Token::End => String::from("before the end of the file"),
            _ => format!("before {} at {}", token.describe(), self.place(at)),
        }
    }

    fn place(&self, rest: &[u8]) -> String {
        match self.file.at(&self.first(rest, 0)).position {
            Position::Text { line, column, .. } => format!("line {line}, column {column}"),
            _ => String::from("an unknown line"),
        }
    }

    /// `keyword` takes `needed` numbers, but `input` follows after `count` of them.
    pub(super) fn too_few(
        &self,
        keyword: Keyword,
        needed: usize,
        count: usize,
        input: &[u8],
    ) -> Error {
        let name = keyword.name;
        match Token::next(input).0 {
            Token::End | Token::Keyword(_) | Token::Close => {
                let follow = match count {
                    0 => String::from("none follows"),
                    1 => String::from("only 1 follows"),
                    count => format!("only {count} follow"),
                };
                let message = format!("`{name}` needs {needed} numbers, but {follow}");
                let note = format!("expected a number {}", self.before(input));
                self.keyword_error(keyword, message).note(note)
            }
            _ => self
                .found(input, "a number")
                .note(format!("`{name}` takes {needed} numbers")),
        }
    }

    /// One more number follows the `needed` ones that `keyword` takes.
    pub(super) fn too_many(&self, keyword: Keyword, needed: usize, input: &[u8]) -> Error {
        let (name, (token, at)) = (keyword.name, Token::next(input));
        let message = format!("{} is one argument too many for `{name}`", token.describe());
        let error = self.error(at, token.length(), message);
        error.note(format!("`{name}` takes {needed} numbers"))
    }

    /// `input` is not the `argument` that `keyword` takes.
    pub(super) fn no_argument(&self, keyword: Keyword, argument: &str, input: &[u8]) -> Error {
        match Token::next(input).0 {
            Token::End | Token::Keyword(_) => {
                let message = format!("`{}` needs {argument}", keyword.name);
                let note = format!("expected it {}", self.before(input));
                self.keyword_error(keyword, message).note(note)
            }
            _ => self.found(input, argument),
        }
    }

    /// `input` is not the string that `keyword` takes.
    pub(super) fn no_string(&self, keyword: Keyword, input: &[u8]) -> Error {
        let error = self.no_argument(keyword, "a string in quotes", input);
        advise_on_word(error, Token::next(input).0)
    }

    /// The string at `input` has no closing quote on its line.
    pub(super) fn unclosed_string(&self, input: &[u8]) -> Error {
        let error = self.error(input, 1, "this string is not closed");
        error.note("a string ends with `\"` on the line where it begins")
    }

    /// `after` follows the backslash at `backslash`.
    pub(super) fn unknown_escape(&self, after: &[u8], backslash: &[u8]) -> Error {
        let letter = String::from_utf8_lossy(&after[..after.len().min(4)]);
        let letter: String = letter.chars().take(1).collect();
        let message = format!("unknown escape `\\{letter}` in a string");
        let error = self.error(backslash, 1 + letter.len(), message);
        error.note("write `\\\\` for a backslash; paths take `/` on every system")
    }

    /// The bracket at `open` is not closed before `input`.
    pub(super) fn unclosed(&self, open: &[u8], input: &[u8]) -> Error {
        let error = self.error(open, 1, "this `[` is not closed");
        error.note(format!("expected `]` {}", self.before(input)))
    }

    /// `input` follows `values` in the array that begins at `open`.
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
            Token::Word(_) => return advise_on_word(self.found(input, one), token),
            _ => {}
        }
        let message = format!("found {} in {kind}", token.describe());
        let begins = format!(
            "the array begins at {}: is its `]` missing?",
            self.place(open)
        );
        self.error(at, token.length(), message).note(begins)
    }

    /// The string at `span` is `found`, not a boolean.
    pub(super) fn no_boolean(&self, span: &Span, found: &str) -> Error {
        let found = shorten(found.as_bytes());
        let message = format!("found the string \"{found}\" where a boolean is expected");
        self.file
            .error(span, message)
            .note("expected `true` or `false`")
    }

    /// `input` is not a value of `declared`.
    pub(super) fn no_value(&self, declared: &Declaration, input: &[u8]) -> Error {
        let token = Token::next(input).0;
        match token {
            Token::End | Token::Keyword(_) | Token::Quoted(_) => {
                let name = shorten(declared.name.as_bytes());
                let message = format!("the parameter `{name}` has no value");
                let error = self.file.error(&declared.span, message);
                error.note(format!("expected a value {}", self.before(input)))
            }
            _ => advise_on_word(self.found(input, "a value"), token),
        }
    }

    /// A second value follows the one of `declared`.
    pub(super) fn second_value(&self, declared: &Declaration, input: &[u8]) -> Error {
        let error = self.found(input, "a parameter or a directive");
        let declaration = format!("{} {}", declared.type_name, declared.name);
        let declaration = shorten(declaration.as_bytes());
        error.note(format!(
            "several values need brackets: `\"{declaration}\" [...]`"
        ))
    }

    /// The string at `span` has only one `word`, or none.
    pub(super) fn half_declaration(&self, span: &Span, word: &str) -> Error {
        let message = match word {
            "" => String::from("this string declares no parameter"),
            word => format!("the parameter \"{}\" has no type", shorten(word.as_bytes())),
        };
        let error = self.file.error(span, message);
        error.note("expected a type and a name, such as \"float radius\" or \"point3 P\"")
    }

    /// `input` is not a directive. `previous` is the keyword of the one before it.
    pub(super) fn no_directive(&self, previous: Option<&str>, input: &[u8]) -> Error {
        let (token, at) = Token::next(input);
        match token {
            Token::Word(word) if is_text(word) && !looks_numeric(word) => {
                self.unknown_directive(word, at)
            }
            Token::Quoted(_) if token.length() == 1 => self.unclosed_string(at),
            Token::Close => {
                let error = self.error(at, 1, "this `]` closes nothing");
                error.note("there is no `[` that is still open before it")
            }
            _ => self.found(input, "a directive").note(match previous {
                Some(name) => format!("`{name}` before it takes no more arguments"),
                None => "a scene begins with a directive such as `LookAt` or `Camera`".to_owned(),
            }),
        }
    }

    fn unknown_directive(&self, word: &[u8], at: &[u8]) -> Error {
        let message = format!("unknown directive `{}`", shorten(word));
        let error = self.error(at, word.len(), message);
        match spelling::closest(&String::from_utf8_lossy(word), KEYWORDS.into_iter()) {
            Some(keyword) => error.note(format!("did you mean `{keyword}`?")),
            None => error.note("expected a directive such as `Shape` or `Translate`"),
        }
    }
}

/// Whether `word` looks like an attempt at a number.
fn looks_numeric(word: &[u8]) -> bool {
    let digits = word
        .strip_prefix(b"-")
        .or(word.strip_prefix(b"+"))
        .unwrap_or(word);
    let digits = digits.strip_prefix(b".").unwrap_or(digits);
    digits.first().is_some_and(u8::is_ascii_digit)
}

/// `error`, with advice if it is about a bare word.
fn advise_on_word(error: Error, token: Token) -> Error {
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
