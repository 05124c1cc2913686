//! Numbers in messages: thousands separated, nouns in the plural.

/// `number` with a comma before each group of three digits: "1,234".
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3 + 1);
    for (place, digit) in digits.char_indices() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A number with its noun: "1 face with ...", "2,000 faces with ...". Puts the first word of `noun`
/// into the plural if needed.
pub fn counted(count: u64, noun: &str) -> String {
    let (word, rest) = noun.split_at(noun.find(' ').unwrap_or(noun.len()));
    match (count, word) {
        (1, _) => format!("1 {noun}"),
        (_, "vertex") => format!("{} vertices{rest}", grouped(count)),
        (_, "index") => format!("{} indices{rest}", grouped(count)),
        _ => format!("{} {word}s{rest}", grouped(count)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_separated() {
        for (number, expected) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (123_456, "123,456"),
            (u64::MAX, "18,446,744,073,709,551,615"),
        ] {
            assert_eq!(grouped(number), expected);
        }
    }

    #[test]
    fn nouns_are_in_the_plural() {
        for (count, noun, expected) in [
            (1, "face of no area", "1 face of no area"),
            (0, "face of no area", "0 faces of no area"),
            (1200, "vertex", "1,200 vertices"),
        ] {
            assert_eq!(counted(count, noun), expected);
        }
    }
}
