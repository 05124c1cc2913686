//! Standard error as a terminal even where it is none, for `--progress always`.

use indicatif::TermLike;
use std::io::{self, Write};

/// Draws with ANSI codes on standard error, 80 columns wide.
#[derive(Debug)]
pub(super) struct AlwaysTerminal;

impl AlwaysTerminal {
    fn print(&self, text: &str) -> io::Result<()> {
        io::stderr().write_all(text.as_bytes())
    }

    fn step(&self, count: usize, direction: char) -> io::Result<()> {
        if count == 0 {
            Ok(())
        } else {
            self.print(&format!("\x1b[{count}{direction}"))
        }
    }
}

impl TermLike for AlwaysTerminal {
    fn width(&self) -> u16 {
        80
    }

    fn move_cursor_up(&self, count: usize) -> io::Result<()> {
        self.step(count, 'A')
    }

    fn move_cursor_down(&self, count: usize) -> io::Result<()> {
        self.step(count, 'B')
    }

    fn move_cursor_right(&self, count: usize) -> io::Result<()> {
        self.step(count, 'C')
    }

    fn move_cursor_left(&self, count: usize) -> io::Result<()> {
        self.step(count, 'D')
    }

    fn write_line(&self, line: &str) -> io::Result<()> {
        self.print(&format!("{line}\n"))
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.print(text)
    }

    fn clear_line(&self) -> io::Result<()> {
        self.print("\r\x1b[2K")
    }

    fn flush(&self) -> io::Result<()> {
        io::stderr().flush()
    }
}
