//! Values as `Debug` writes them, read back.

use std::iter::Peekable;
use std::str::Chars;

/// A value by its parts.
#[derive(Debug, Clone, PartialEq)]
pub enum Printed {
    Number(f64),
    Word(String),
    List(Vec<Printed>),
    /// `name { field: value, .. }`
    Fields(String, Vec<(String, Printed)>),
    /// `name(value, ..)`
    Case(String, Vec<Printed>),
}

impl Printed {
    /// All numbers in it, in order.
    pub fn numbers(&self, numbers: &mut Vec<f64>) {
        match self {
            Self::Number(number) => numbers.push(*number),
            Self::Word(_) => {}
            Self::List(all) | Self::Case(_, all) => all.iter().for_each(|one| one.numbers(numbers)),
            Self::Fields(_, all) => all.iter().for_each(|(_, one)| one.numbers(numbers)),
        }
    }
}

/// Reads a value.
pub fn read(text: &str) -> Printed {
    let mut letters = text.chars().peekable();
    let value = value(&mut letters);
    assert_eq!(letters.next(), None, "{text}");
    value
}

type Letters<'t> = Peekable<Chars<'t>>;

fn skip(letters: &mut Letters) {
    while letters.next_if(|letter| letter.is_whitespace() || *letter == ',').is_some() {}
}

fn several(letters: &mut Letters, end: char) -> Vec<Printed> {
    let mut all = Vec::new();
    loop {
        skip(letters);
        if letters.next_if_eq(&end).is_some() {
            return all;
        }
        all.push(value(letters));
    }
}

fn word(letters: &mut Letters) -> String {
    let mut word = String::new();
    while let Some(letter) = letters.next_if(|letter| letter.is_alphanumeric() || "_+-.#".contains(*letter)) {
        word.push(letter);
    }
    word
}

fn value(letters: &mut Letters) -> Printed {
    skip(letters);
    match letters.peek().expect("a value") {
        '[' => {
            letters.next();
            Printed::List(several(letters, ']'))
        }
        '(' => {
            letters.next();
            Printed::List(several(letters, ')'))
        }
        '"' => {
            letters.next();
            let mut text = String::new();
            while let Some(letter) = letters.next_if(|letter| *letter != '"') {
                text.push(letter);
            }
            letters.next();
            Printed::Word(text)
        }
        _ => {
            let word = word(letters);
            assert!(!word.is_empty(), "{:?}", letters.collect::<String>());
            skip(letters);
            if letters.next_if_eq(&'(').is_some() {
                return Printed::Case(word, several(letters, ')'));
            }
            if letters.next_if_eq(&'{').is_some() {
                let mut fields = Vec::new();
                loop {
                    skip(letters);
                    if letters.next_if_eq(&'}').is_some() {
                        return Printed::Fields(word, fields);
                    }
                    let name = self::word(letters);
                    assert_eq!(letters.next(), Some(':'), "{name}");
                    fields.push((name.trim_start_matches("r#").to_owned(), value(letters)));
                }
            }
            word.parse().map_or(Printed::Word(word), Printed::Number)
        }
    }
}
