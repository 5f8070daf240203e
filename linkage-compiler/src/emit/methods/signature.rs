//! Signatures of functions, from words that are made once.

use proc_macro2::{Delimiter, Ident, Literal};

use super::super::names::ident;
use super::super::tokens::Tokens;

/// The words that signatures are made of.
pub(super) struct Words {
    pub own: Ident,
    pub own_type: Ident,
    scalar: Ident,
    public: Ident,
    function: Ident,
    must_use: Ident,
    generic: Ident,
    into: Ident,
    result: Ident,
    error: Ident,
}

impl Words {
    pub(super) fn new() -> Self {
        Self {
            own: ident("self"),
            own_type: ident("Self"),
            scalar: ident("T"),
            public: ident("pub"),
            function: ident("fn"),
            must_use: ident("must_use"),
            generic: ident("impl"),
            into: ident("Into"),
            result: ident("Result"),
            error: ident("Error"),
        }
    }

    /// `T`
    pub(super) fn scalar(&self) -> Tokens {
        Tokens::name(&self.scalar)
    }

    /// `Name<T>`
    pub(super) fn of(&self, name: &Ident) -> Tokens {
        Tokens::name(name).of([self.scalar()])
    }

    /// `SVector<T, 2>`, `SMatrix<T, 2, 1>`
    pub(super) fn sized<const N: usize>(&self, name: &str, sizes: [usize; N]) -> Tokens {
        let sizes = sizes.map(|size| Tokens::from(Literal::usize_unsuffixed(size)));
        Tokens::name(&ident(name)).of([self.scalar()].into_iter().chain(sizes))
    }

    /// `argument: &Name<T>`
    pub(super) fn borrowed(&self, argument: &Ident, name: &Ident) -> Tokens {
        let mut tokens = Tokens::name(argument);
        tokens.punct(':');
        tokens.punct('&');
        tokens.join(self.of(name));
        tokens
    }

    /// `argument: impl Into<Name<T>>`
    pub(super) fn converted(&self, argument: &Ident, name: &Ident) -> Tokens {
        let mut tokens = Tokens::name(argument);
        tokens.punct(':');
        tokens.ident(&self.generic);
        tokens.join(Tokens::name(&self.into).of([self.of(name)]));
        tokens
    }

    /// `#[must_use] pub fn name(&self, …) -> Type`
    pub(super) fn total<const N: usize>(&self, name: &str, arguments: [Tokens; N], of: Tokens) -> Tokens {
        let mut tokens = Tokens::default();
        tokens.punct('#');
        tokens.group(Delimiter::Bracket, Tokens::name(&self.must_use));
        tokens.join(self.returning(name, arguments, of));
        tokens
    }

    /// `pub fn name(&self, …) -> Result<Type, Error>`
    pub(super) fn fallible(&self, name: &str, arguments: impl IntoIterator<Item = Tokens>, of: Tokens) -> Tokens {
        self.returning(name, arguments, Tokens::name(&self.result).of([of, Tokens::name(&self.error)]))
    }

    fn returning(&self, name: &str, arguments: impl IntoIterator<Item = Tokens>, of: Tokens) -> Tokens {
        let mut inside = Tokens::default();
        inside.punct('&');
        inside.ident(&self.own);
        for argument in arguments {
            inside.punct(',');
            inside.join(argument);
        }
        let mut tokens = Tokens::name(&self.public);
        tokens.ident(&self.function);
        tokens.ident(&ident(name));
        tokens.group(Delimiter::Parenthesis, inside);
        tokens.arrow();
        tokens.join(of);
        tokens
    }
}
