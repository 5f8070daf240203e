//! A document that does not hold together is an error; what is lent of a sound one outlives it.

use linkage_compiler::document::{DriverDocument, FormulaNodes, Node, SceneDocument, SheetDocument, Table};
use linkage_report::Document as _;
use linkage_report::lend::{Lender, Unsound};

const TEXT: &str = "mechanism FourBar {
    param l1 = 80, l2 = 20, l3 = 50, l4 = 70, m = 2;
    input theta2;
    unknown theta3, theta4;
    loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
    point C = l2@theta2 + l3@theta3;
    body Load { mass m; inertia 0; center C; angle 0; }
    scene Falling { inertia; gravity (0, -9.81); }
    derive sheet;
}";

fn documents() -> (DriverDocument, SceneDocument, SheetDocument) {
    let mechanism = linkage_compiler::read(TEXT.parse().unwrap()).unwrap().remove(0);
    let (mut drivers, mut scenes) = linkage_compiler::documents(&mechanism).unwrap();
    let mut sheets = linkage_compiler::sheets(&mechanism).unwrap();
    (drivers.remove(0), scenes.remove(0), sheets.remove(0))
}

#[test]
fn what_is_lent_outlives_its_document() {
    let lender = Lender::default();
    let (derivation, scene, sheet) = {
        let (driver, scene, sheet) = documents();
        (lender.derivation(&driver).unwrap(), lender.scene(&scene).unwrap(), lender.sheet(&sheet).unwrap())
    };
    assert!(derivation.to_text().contains("det J = −l₃·l₄·sin(θ₃ − θ₄)"));
    assert!(scene.to_text().contains("Falling"));
    assert!(sheet.to_text().contains("γ_u"));
}

/// A table that has too few formulas for each kind of document.
#[test]
fn a_missing_formula_is_an_error() {
    let (driver, scene, sheet) = documents();
    let nodes: FormulaNodes = {
        let mut table = Table::default();
        table.plain("theta2");
        table.nodes()
    };
    let lender = Lender::default();
    let missing = |error: Unsound| matches!(error, Unsound::Formula(number) if number > 1);
    assert!(missing(lender.derivation(&DriverDocument { nodes: nodes.clone(), ..driver }).unwrap_err()));
    assert!(missing(lender.scene(&SceneDocument { nodes: nodes.clone(), ..scene }).unwrap_err()));
    assert!(missing(lender.sheet(&SheetDocument { nodes, ..sheet }).unwrap_err()));
}

#[test]
fn a_derivative_of_no_name_is_an_error() {
    let mut table = Table::default();
    let pi = table.add(Node::Pi);
    table.add(Node::Rate(pi));
    assert_eq!(Lender::default().table(&table.nodes()).unwrap_err(), Unsound::Table);
}

#[test]
fn a_missing_place_is_an_error() {
    let (mut driver, _, mut sheet) = documents();
    let lender = Lender::default();
    driver.record.groups[0].equations[1] = 2;
    let error = lender.derivation(&driver).unwrap_err();
    assert_eq!(error, Unsound::Place { list: "equations", place: 2 });
    assert_eq!(error.to_string(), "the document has no item 2 in its list of equations");
    driver.record.groups[0].equations[1] = 1;
    driver.record.chain.as_mut().unwrap().joints[0].links[1] = 9;
    assert_eq!(lender.derivation(&driver).unwrap_err(), Unsound::Place { list: "links", place: 9 });
    driver.record.chain.as_mut().unwrap().joints[0].links[1] = 1;
    driver.record.jacobian_inputs.entries[0].column = 1;
    assert_eq!(lender.derivation(&driver).unwrap_err(), Unsound::Place { list: "columns", place: 1 });
    sheet.record.points[0].vectors.push(2);
    assert_eq!(lender.sheet(&sheet).unwrap_err(), Unsound::Place { list: "vectors", place: 2 });
}
