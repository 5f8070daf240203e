//! A table of trigonometric identities.

use linkage_equality::Answer;

use crate::algebra::formula::Formulas;

const TABLE: [(&str, &str); 48] = [
    // Multiple angles.
    ("sin(2*x)", "2*sin(x)*cos(x)"),
    ("cos(2*x)", "2*cos(x)^2 - 1"),
    ("cos(2*x)", "(1 - tan(x)^2)/(1 + tan(x)^2)"),
    ("sin(3*x)", "3*sin(x) - 4*sin(x)^3"),
    ("cos(3*x)", "4*cos(x)^3 - 3*cos(x)"),
    ("tan(3*x)", "(3*tan(x) - tan(x)^3)/(1 - 3*tan(x)^2)"),
    ("cos(5*x)", "16*cos(x)^5 - 20*cos(x)^3 + 5*cos(x)"),
    ("sin(3*x)", "4*sin(x)*sin(pi/3 - x)*sin(pi/3 + x)"),
    ("tan(3*x)", "tan(x)*tan(pi/3 - x)*tan(pi/3 + x)"),
    // Half angles.
    ("sin(x/2)^2", "(1 - cos(x))/2"),
    ("tan(x/2)", "sin(x)/(1 + cos(x))"),
    ("tan(x/2)", "(1 - cos(x))/sin(x)"),
    ("sin(x)", "2*tan(x/2)/(1 + tan(x/2)^2)"),
    ("cos(x)", "(1 - tan(x/2)^2)/(1 + tan(x/2)^2)"),
    ("tan(x)", "2*tan(x/2)/(1 - tan(x/2)^2)"),
    ("tan(x/2 + pi/4)", "(1 + sin(x))/cos(x)"),
    // Powers.
    ("sin(x)^4", "(3 - 4*cos(2*x) + cos(4*x))/8"),
    ("cos(x)^4 - sin(x)^4", "cos(2*x)"),
    ("sin(x)^6 + cos(x)^6", "1 - 3*sin(2*x)^2/4"),
    ("1/cos(x)^2", "1 + tan(x)^2"),
    // Sums and products.
    ("sin(x + y)", "sin(x)*cos(y) + cos(x)*sin(y)"),
    ("tan(x + y)", "(tan(x) + tan(y))/(1 - tan(x)*tan(y))"),
    ("sin(x) + sin(y)", "2*sin((x + y)/2)*cos((x - y)/2)"),
    ("cos(x) - cos(y)", "-2*sin((x + y)/2)*sin((x - y)/2)"),
    ("tan(x) - tan(y)", "sin(x - y)/(cos(x)*cos(y))"),
    ("sin(x)*sin(y)", "(cos(x - y) - cos(x + y))/2"),
    ("sin(x + y)*sin(x - y)", "sin(x)^2 - sin(y)^2"),
    ("cos(x)*cos(y)*cos(z)", "(cos(x + y + z) + cos(x + y - z) + cos(x - y + z) + cos(y + z - x))/4"),
    ("sin(x) + sin(y) + sin(z) - sin(x + y + z)", "4*sin((x + y)/2)*sin((y + z)/2)*sin((x + z)/2)"),
    ("sin(2*x) + sin(2*y) - sin(2*x + 2*y)", "4*sin(x)*sin(y)*sin(x + y)"),
    ("tan(x) + tan(y) - tan(x + y)", "-tan(x)*tan(y)*tan(x + y)"),
    ("(sin(x) + sin(y))/(cos(x) + cos(y))", "tan((x + y)/2)"),
    ("sin(x + 2*pi/3) + sin(x - 2*pi/3)", "-sin(x)"),
    // Finite sums and products.
    ("1 + 2*cos(x) + 2*cos(2*x) + 2*cos(3*x)", "sin(7*x/2)/sin(x/2)"),
    ("sin(x) + sin(2*x) + sin(3*x) + sin(4*x)", "sin(2*x)*sin(5*x/2)/sin(x/2)"),
    ("cos(x)*cos(2*x)*cos(4*x)", "sin(8*x)/(8*sin(x))"),
    // Constants.
    ("cos(pi/9)*cos(2*pi/9)*cos(4*pi/9)", "1/8"),
    ("cos(pi/5) - cos(2*pi/5)", "1/2"),
    ("4*sin(pi/10)^2 + 2*sin(pi/10)", "1"),
    ("cos(2*pi/7) + cos(4*pi/7) + cos(6*pi/7)", "-1/2"),
    ("tan(pi/8)^2 + 2*tan(pi/8)", "1"),
    ("cos(pi/12)*sin(pi/12)", "1/4"),
    ("16*cos(2*pi/17)*cos(4*pi/17)*cos(8*pi/17)*cos(16*pi/17)", "-1"),
    ("(tan(3*pi/11) + 4*sin(2*pi/11))^2", "11"),
    // Angles that are numbers, products and functions.
    ("sin(1)^2 + cos(1)^2 + cos(2)", "2*cos(1)^2"),
    ("cos(x*(y + z))", "cos(x*y)*cos(x*z) - sin(x*y)*sin(x*z)"),
    ("sin(2*x*sin(y))", "2*sin(x*sin(y))*cos(x*sin(y))"),
    ("cos(x/y)^2 + sin(x/y)^2", "1"),
];

#[test]
fn identities_of_the_table() {
    for (left, right) in TABLE {
        let mut formulas = Formulas::default();
        assert_eq!(formulas.compare(left, right), Answer::Equal, "{left} = {right}");
    }
}

/// The table with a small error on one side of each identity.
#[test]
fn the_table_with_a_mistake() {
    for (left, right) in TABLE {
        let mut formulas = Formulas::default();
        let wrong = format!("{right} + sin(x)/1000");
        assert_eq!(formulas.compare(left, &wrong), Answer::Different, "{left} = {wrong}");
        let wrong = format!("({right})*1000001/1000000");
        assert_eq!(formulas.compare(left, &wrong), Answer::Different, "{left} = {wrong}");
    }
}

#[test]
fn constants_close_to_each_other_are_told_apart() {
    let mut formulas = Formulas::default();
    for (left, right) in [
        // Equal to eight, nine and fifteen digits.
        ("pi", "355/113"),
        ("pi^4", "2143/22"),
        ("sin(11)", "-1 + 1/102093"),
        ("cos(355)", "-1"),
        ("sin(pi/180)", "pi/180"),
    ] {
        assert_eq!(formulas.compare(left, right), Answer::Different, "{left} and {right}");
    }
}
