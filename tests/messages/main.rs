//! Messages of the macro: one for each mistake, on its token.

mod checked;
mod one_message;
mod plain_words;
mod trait_objects;
mod ui;
