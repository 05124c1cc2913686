//! Text for terminals, without control characters: names from files and from the command line may
//! hold anything.

/// Returns true for control characters, which a terminal executes, and for characters that change
/// the direction of writing.
pub fn is_command(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// One line of text, with a replacement character for each control character.
pub fn line(text: &str) -> String {
    let printable = |c| {
        if is_command(c) {
            char::REPLACEMENT_CHARACTER
        } else {
            c
        }
    };
    text.chars().map(printable).collect()
}

/// Like [`line()`], for several lines, which keep their ends.
pub fn lines(text: &str) -> String {
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_control_characters_are_replaced() {
        let name = "a\x1b]0;T\x07\u{9b}31m\u{7f}\u{202e}gnp.\u{2066}\u{200f}\u{2028}ä€😀 \u{301}";
        assert_eq!(
            line(name),
            "a\u{fffd}]0;T\u{fffd}\u{fffd}31m\u{fffd}\u{fffd}gnp.\u{fffd}\u{fffd}\u{fffd}ä€😀 \u{301}"
        );
        assert_eq!(line("a\nb"), "a\u{fffd}b");
        assert_eq!(lines("a\nb\r\n\tc\n"), "a\nb\u{fffd}\n\u{fffd}c\n");
    }
}
