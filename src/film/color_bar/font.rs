//! A bitmap font of the few characters that a colour bar needs.

/// Columns and rows of a character.
pub(super) const WIDTH: usize = 5;
/// See [`WIDTH`].
pub(super) const HEIGHT: usize = 7;
/// Columns from one character to the next.
pub(super) const ADVANCE: usize = WIDTH + 1;

/// Rows from the top; the lowest [`WIDTH`] bits of each are its columns, the highest on the left.
type Glyph = [u8; HEIGHT];

/// The dots of `character`, as column and row. One that the font lacks has none, like a blank.
pub(super) fn dots(character: char) -> impl Iterator<Item = (usize, usize)> {
    let rows = glyph(character).unwrap_or_default();
    let is_set = move |(x, y): &(usize, usize)| rows[*y] >> (WIDTH - 1 - x) & 1 == 1;
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    places.filter(is_set)
}

#[rustfmt::skip]
fn glyph(character: char) -> Option<Glyph> {
    Some(match character {
        '0' | 'O' => [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00010, 0b00100, 0b01000, 0b11111],
        '3' => [0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100],
        '-' => [0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000],
        'e' => [0b00000, 0b00000, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110],
        'C' => [0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110],
        'D' => [0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110],
        'E' => [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111],
        'H' => [0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001],
        'P' => [0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000],
        'S' => [0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110],
        'T' => [0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100],
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_differ_and_stay_in_their_box() {
        let characters = "0123456789.-eCDEHPST";
        let glyphs: Vec<Glyph> = characters.chars().map(|c| glyph(c).unwrap()).collect();
        for (place, rows) in glyphs.iter().enumerate() {
            assert!(rows.iter().all(|row| *row < 1 << WIDTH));
            assert!(!glyphs[..place].contains(rows), "{place}");
        }
        assert_eq!(
            dots('-').collect::<Vec<_>>(),
            [0, 1, 2, 3, 4].map(|x| (x, 3))
        );
        assert_eq!(dots(' ').count(), 0);
    }
}
