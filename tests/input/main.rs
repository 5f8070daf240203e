//! Extreme and invalid input: errors, no panic, no number that is not finite.

mod invalid_numbers;
mod robustness;
mod token_sequences;
