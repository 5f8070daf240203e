//! The elementary functions that formulas call.

macro_rules! functions {
    ($($(#[$doc:meta])* $variant:ident $name:literal $arity:literal $method:literal $mathematics:literal $fpcore:literal)*) => {
        /// An elementary function of real numbers.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[expect(missing_docs, reason = "the names are those of mathematics")]
        pub enum ElementaryFunction {$(
            $(#[$doc])*
            $variant,
        )*}

        impl ElementaryFunction {
            /// All of them, in the order of the variants.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            const ROWS: &'static [Row] = &[$(Row {
                name: $name, arity: $arity, method: $method, in_mathematics: $mathematics, in_fpcore: $fpcore,
            }),*];
        }
    };
}

struct Row {
    name: &'static str,
    arity: usize,
    method: &'static str,
    in_mathematics: &'static str,
    in_fpcore: &'static str,
}

functions! {
    // Name in the language, number of arguments, method of a scalar, name in mathematics, name in FPCore.
    Sin "sin" 1 "sine" "sin" "sin"
    Cos "cos" 1 "cosine" "cos" "cos"
    Tan "tan" 1 "tangent" "tan" "tan"
    Asin "asin" 1 "arcsine" "arcsin" "asin"
    Acos "acos" 1 "arccosine" "arccos" "acos"
    Atan "atan" 1 "arctangent" "arctan" "atan"
    Atan2 "atan2" 2 "arctangent2" "atan2" "atan2"
    Sqrt "sqrt" 1 "sqrt" "sqrt" "sqrt"
    Abs "abs" 1 "abs" "abs" "fabs"
    Exp "exp" 1 "exponential" "exp" "exp"
    Ln "ln" 1 "logarithm" "ln" "log"
    Hypot "hypot" 2 "hypotenuse" "hypot" "hypot"
    /// `if_nonzero(a, v, w)`: v, or its limit w where a is zero and v may be 0 / 0. Not in the language.
    IfNonzero "if_nonzero" 3 "if_nonzero" "if_nonzero" "if_nonzero"
}

impl ElementaryFunction {
    fn row(self) -> &'static Row {
        &Self::ROWS[self as usize]
    }

    /// The name in the `linkage!` language, or that of a function which is not in it.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The number of arguments.
    #[must_use]
    pub fn arity(self) -> usize {
        self.row().arity
    }

    /// The method of a scalar that computes it.
    #[must_use]
    pub fn method(self) -> &'static str {
        self.row().method
    }

    /// The usual name in mathematics.
    #[must_use]
    pub fn in_mathematics(self) -> &'static str {
        self.row().in_mathematics
    }

    /// The name in FPCore.
    #[must_use]
    pub fn in_fpcore(self) -> &'static str {
        self.row().in_fpcore
    }

    /// The functions of the language.
    pub fn written() -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().filter(|function| *function != Self::IfNonzero)
    }

    /// The function of this name in the language.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::written().find(|function| function.name() == name)
    }
}
