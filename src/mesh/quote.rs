//! Quotes words of files in messages.

/// `word` between backquotes, shortened to fit a line: a broken file may be one long word.
pub(super) fn quote(word: &[u8]) -> String {
    const MOST: usize = 40;
    let text = String::from_utf8_lossy(&word[..word.len().min(MOST)]);
    let text: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let dots = if word.len() > MOST { "..." } else { "" };
    format!("`{text}{dots}`")
}
