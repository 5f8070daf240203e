//! Text for a terminal. Names of files, arguments and comments may have control characters, which a terminal obeys: they are shown
//! by their symbols instead.

/// The symbols of the control characters begin here, that of NUL: `␀`.
const SYMBOLS: u32 = 0x2400;

/// The text without control characters but for ends of lines and tabs.
pub fn printable(text: &str) -> String {
    let shown = |letter: char| match letter {
        '\n' | '\t' => letter,
        '\u{7f}' => '␡',
        '\0'..='\u{1f}' => char::from_u32(SYMBOLS + u32::from(letter)).unwrap_or(char::REPLACEMENT_CHARACTER),
        letter if letter.is_control() => char::REPLACEMENT_CHARACTER,
        letter => letter,
    };
    text.chars().map(shown).collect()
}

/// Prints a line on standard error.
macro_rules! say {
    ($($text:tt)*) => {
        anstream::eprintln!("{}", $crate::terminal::printable(&format!($($text)*)))
    };
}

pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::printable;

    #[test]
    fn control_characters_are_shown() {
        assert_eq!(printable("a\u{1b}[31m\r\0\u{7f}\u{9b}\n\tü"), "a␛[31m␍␀␡\u{fffd}\n\tü");
    }
}
