//! Names of cameras: parts of file names, each unique in its list.

use super::checks::Refusal;
use crate::terminal_text::is_command;
use std::collections::HashMap;

/// The longest name in bytes: it becomes part of a file name.
const MAX_NAME: usize = 100;

/// Whether a character cannot be in a name.
fn is_bad(c: char) -> bool {
    is_command(c) || "/\\:*?\"<>|{}".contains(c)
}

/// # Errors
/// The name cannot be part of a file name.
pub(super) fn check_name(name: &str) -> Result<(), Refusal> {
    if name.is_empty() || name.len() > MAX_NAME || name.starts_with('.') || name.contains(is_bad) {
        let expected = format!("a part of a file name, of at most {MAX_NAME} bytes");
        return Err((
            "the name cannot be part of a file name".to_owned(),
            expected,
        ));
    }
    Ok(())
}

/// Names for cameras of images: the images' names without folder and extension. Where several
/// images share one, folders are part of it: `left-0001` for `left/0001.png`. What cannot be in a
/// file name becomes `_`.
pub(super) fn names_of_images(images: &[&str]) -> Vec<String> {
    let short = images.iter().map(|image| {
        let file = image.rsplit(['/', '\\']).next().unwrap_or(image);
        printable(without_extension(file))
    });
    let mut names: Vec<String> = short.collect();
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for name in &names {
        *counts.entry(name).or_default() += 1;
    }
    let is_shared: Vec<bool> = names.iter().map(|name| counts[name.as_str()] > 1).collect();
    for ((name, image), is_shared) in names.iter_mut().zip(images).zip(is_shared) {
        if is_shared {
            let folders = image.split(['/', '\\']);
            let folders = folders.filter(|folder| !["", ".", ".."].contains(folder));
            let folders: Vec<&str> = folders.collect();
            *name = printable(without_extension(&folders.join("-")));
        }
    }
    names
}

fn without_extension(file: &str) -> &str {
    match file.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => file,
    }
}

fn printable(name: &str) -> String {
    let name = name.replace(is_bad, "_");
    match name.strip_prefix('.') {
        Some(rest) => format!("_{rest}"),
        None => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_give_their_names() {
        let names = names_of_images(&["./train/r_0", "train/IMG 7.JPG", "a.b.png", ".hidden"]);
        assert_eq!(names, ["r_0", "IMG 7", "a.b", "_hidden"]);
    }

    #[test]
    fn folders_tell_images_of_one_name_apart() {
        let names = names_of_images(&["left/1.png", "./right/1.png", "c:\\x\\2.png"]);
        assert_eq!(names, ["left-1", "right-1", "2"]);
        assert_eq!(names_of_images(&["a:b{c}.png"]), ["a_b_c_"]);
    }

    #[test]
    fn names_that_no_file_can_have_are_refused() {
        for name in ["", ".a", "a/b", "a\nb", &"x".repeat(101)] {
            assert!(check_name(name).is_err(), "{name}");
        }
        assert!(check_name("a b-c.d").is_ok());
    }
}
