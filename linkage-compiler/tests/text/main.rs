//! Texts at run time, those of strangers among them: messages, bounded work, no panic.

mod mutants;
mod strangers;
