//! The values of elementary functions.

use linkage_ir::ElementaryFunction as Function;

/// A function as emitted code calls it; returns None unless it has so many arguments, and for functions that compare numbers.
macro_rules! called {
    ($function:expr, $arguments:expr) => {
        match ($function, $arguments) {
            (Function::Sin, &[x]) => x.sine(),
            (Function::Cos, &[x]) => x.cosine(),
            (Function::Tan, &[x]) => x.tangent(),
            (Function::Asin, &[x]) => x.arcsine(),
            (Function::Acos, &[x]) => x.arccosine(),
            (Function::Atan, &[x]) => x.arctangent(),
            (Function::Atan2, &[y, x]) => y.arctangent2(x),
            (Function::Sqrt, &[x]) => x.sqrt(),
            (Function::Abs, &[x]) => x.abs(),
            (Function::Exp, &[x]) => x.exponential(),
            (Function::Ln, &[x]) => x.logarithm(),
            (Function::Hypot, &[x, y]) => x.hypotenuse(y),
            _ => return None,
        }
    };
}

/// The value of an elementary function of real numbers, with the bits of emitted code. None unless it has so many arguments.
pub fn value_of<T: crate::Real>(function: Function, arguments: &[T]) -> Option<T> {
    if let (Function::IfNonzero, &[a, value, limit]) = (function, arguments) {
        return Some(a.if_nonzero(value, limit));
    }
    Some(called!(function, arguments))
}

/// The value of an elementary function of numbers without order, such as intervals. None unless it has so many arguments, and
/// for [`IfNonzero`](Function::IfNonzero), which compares.
pub fn number_of<N: crate::Number>(function: Function, arguments: &[N]) -> Option<N> {
    Some(called!(function, arguments))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An elementary function without an arm above would have no value in the interpreter, and be unknown in certificates.
    #[test]
    fn every_elementary_function_has_a_value() {
        for &function in Function::ALL {
            let arguments = &[0.5; 3][..function.arity()];
            assert!(value_of(function, arguments).is_some(), "{function:?}");
            // It compares.
            let is_number = function != Function::IfNonzero;
            assert_eq!(number_of(function, arguments).is_some(), is_number, "{function:?}");
        }
    }
}
