//! Texts at run time, those of strangers among them: messages, bounded work, no panic.

mod measures;
mod messages;
mod mutants;
mod strangers;
