//! How names are written in the source of a formula.

/// The meaning of a symbol, which decides how it is shown. Names are those of the language, such
/// as `theta3` or `z_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name<'a> {
    /// The quantity itself: θ₃.
    Plain(&'a str),
    /// Its first derivative with respect to time: θ̇₃.
    Rate(&'a str),
    /// Its second derivative with respect to time: θ̈₃.
    Acceleration(&'a str),
    /// The velocity ratio ∂`of`/∂`by`.
    Ratio { of: &'a str, by: &'a str },
    /// The derivative of a velocity ratio, ∂²`of`/∂`by`∂`by`.
    RatioDerivative { of: &'a str, by: [&'a str; 2] },
    /// The determinant of J, or of the block of J with this number.
    Determinant(Option<usize>),
    /// The inverse of J, or of the block of J with this number.
    Inverse(Option<usize>),
}

impl Name<'_> {
    /// The name as the runtime reads it.
    #[must_use]
    pub fn source(self) -> String {
        let mut out = String::new();
        self.write(&mut out);
        out
    }

    /// Writes the name as the runtime reads it.
    pub fn write(self, out: &mut String) {
        let (open, block, close) = match self {
            Self::Plain(name) => return out.push_str(name),
            Self::Rate(name) => return out.extend([name, "'"]),
            Self::Acceleration(name) => return out.extend([name, "''"]),
            Self::Ratio { of, by } => return out.extend(["∂(", of, ", ", by, ")"]),
            Self::RatioDerivative { of, by } => return out.extend(["∂(", of, ", ", by[0], ", ", by[1], ")"]),
            Self::Determinant(block) => ("|J", block, "|"),
            Self::Inverse(block) => ("J", block, "^-1"),
        };
        out.push_str(open);
        if let Some(block) = block {
            out.push_str(&block.to_string());
        }
        out.push_str(close);
    }
}
