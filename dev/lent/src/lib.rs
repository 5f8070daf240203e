//! The compiler's documents as derivations of the runtime, without emitted constants: what tests compare constants with.
//! The values are never freed.

use linkage_compiler::document::{self, Document, Node, Number, SceneDocument, SheetDocument};
use linkage_compiler::graph::Function;
use linkage_compiler::program;
use linkage_compiler::structure::GroupKind;
use linkage_runtime::derivation::{
    ChainJoint, ChainLink, ChainVector, ContactEffect, Derivation, DriverChoice, Effect, ElementaryFunction, Entry,
    Equation, Formula, FormulaMatrix, FormulaNode, FormulaTable, Group, GroupForm, GroupMethod, JointForce, Kernel,
    KernelCheck, KernelCode, KernelResult, KinematicChain, Operations, PointVectors, Quantity, Root, SceneDerivation,
    Sensitivity, SheetDerivation, Symbol, Turning,
};

/// The derivation of a document.
///
/// # Panics
/// If the table of the document refers to what it does not have.
#[must_use]
pub fn derivation(document: &Document) -> Derivation<'static> {
    let table = Table::of(&document.table);
    Derivation {
        mechanism: text(&document.mechanism),
        parameters: list(&document.parameters, |symbol| table.symbol(symbol)),
        inputs: list(&document.inputs, |symbol| table.symbol(symbol)),
        unknowns: list(&document.unknowns, |symbol| table.symbol(symbol)),
        residual: table.equations(&document.residual),
        implied: table.equations(&document.implied),
        jacobian_unknowns: table.matrix(&document.jacobian_unknowns),
        jacobian_inputs: table.matrix(&document.jacobian_inputs),
        groups: list(&document.groups, |group| table.group(group)),
        determinant: document.determinant.map(|equation| table.equation(equation)),
        ratios: table.equations(&document.ratios),
        ratio_derivatives: document.ratio_derivatives.as_deref().map(|all| table.equations(all)),
        gamma: table.equations(&document.gamma),
        jerk: document.jerk.as_deref().map(|all| table.equations(all)),
        sensitivity: document.sensitivity.as_ref().map(|document::Sensitivity { jacobian, formulas }| Sensitivity {
            jacobian: table.matrix(jacobian),
            formulas: table.equations(formulas),
        }),
        points: list(&document.points, |quantity| table.quantity(quantity)),
        outputs: list(&document.outputs, |quantity| table.quantity(quantity)),
        conditions: table.formulas(&document.conditions),
        chain: document.chain.as_ref().map(|chain| KinematicChain {
            links: list(&chain.links, |(name, turns_with)| ChainLink {
                name: text(name),
                turns_with: list(turns_with, |name| text(name)),
            }),
            joints: list(&chain.joints, |(links, slides_along)| ChainJoint {
                links: *links,
                slides_along: slides_along.as_deref().map(text),
            }),
            conditions: chain.conditions,
        }),
        kernels: list(&document.kernels, |kernel| table.kernel(kernel)),
    }
}

/// The equations of motion of a document.
///
/// # Panics
/// If the table of the document refers to what it does not have.
#[must_use]
pub fn scene(document: &SceneDocument) -> SceneDerivation<'static> {
    let table = Table::of(&document.table);
    SceneDerivation {
        scene: text(&document.scene),
        mechanism: text(&document.mechanism),
        parameters: list(&document.parameters, |symbol| table.symbol(symbol)),
        mass_matrix: table.equations(&document.mass_matrix),
        forces: list(&document.forces, |effect| Effect {
            name: text(&effect.name),
            forces: table.equations(&effect.forces),
        }),
        frictions_and_stops: list(&document.frictions_and_stops, |contact| ContactEffect {
            name: text(&contact.name),
            force: table.formula(contact.force),
            along: table.equation(contact.along),
            bound: table.formula(contact.bound),
            bearing: contact.bearing.as_ref().map(|joint| table.symbol(joint)),
            rebound: contact.rebound.map(|factor| table.formula(factor)),
            forces: table.equations(&contact.forces),
        }),
        drives: table.equations(&document.drives),
        potential: document.potential.map(|equation| table.equation(equation)),
        joints: list(&document.joints, |joint| JointForce {
            name: text(&joint.name),
            components: joint.components.map(|equation| table.equation(equation)),
        }),
        multipliers: table.formulas(&document.multipliers),
        contacts: list(&document.contacts, |symbol| table.symbol(symbol)),
        kernels: list(&document.kernels, |kernel| table.kernel(kernel)),
    }
}

/// The analysis by hand of a document.
///
/// # Panics
/// If the table of the document refers to what it does not have.
#[must_use]
pub fn sheet(document: &SheetDocument) -> SheetDerivation<'static> {
    let table = Table::of(&document.table);
    let matrix = |matrix: &document::Matrix| table.matrix(matrix);
    SheetDerivation {
        mechanism: text(&document.mechanism),
        jacobian_rates: document.jacobian_rates.each_ref().map(matrix),
        jacobians_of_rates: document.jacobians_of_rates.each_ref().map(matrix),
        terms: document.terms.each_ref().map(matrix),
        gamma: document.gamma.each_ref().map(matrix),
        accelerations: document.accelerations.each_ref().map(|all| table.equations(all)),
        choices: list(&document.choices, |choice| DriverChoice {
            inputs: table.formulas(&choice.inputs),
            determinant: choice.determinant.map(|equation| table.equation(equation)),
        }),
        turning: list(&document.turning, |turning| Turning {
            with: list(&turning.with, |name| text(name)),
            rate: table.matrix(&turning.rate),
            acceleration: table.matrix(&turning.acceleration),
        }),
        vectors: list(&document.vectors, |vector| ChainVector {
            vector: table.matrix(&vector.vector),
            matrix: table.matrix(&vector.matrix),
            rates: table.matrix(&vector.rates),
            velocity: table.matrix(&vector.velocity),
            acceleration: table.matrix(&vector.acceleration),
        }),
        points: list(&document.points, |point| PointVectors {
            name: text(&point.name),
            vectors: point.vectors.clone().leak(),
            sums: point.sums.map(|equation| table.equation(equation)),
        }),
        conditions: table.formulas(&document.conditions),
    }
}

/// The nodes of a table.
///
/// # Panics
/// If one refers to what is not before it.
#[must_use]
pub fn table(table: &document::Table) -> FormulaTable<'static> {
    let (mut names, mut parts) = (Vec::new(), Vec::new());
    let nodes: Vec<FormulaNode> = table.nodes().map(|one| node(one, &mut names, &mut parts)).collect();
    FormulaTable::checked(nodes.leak(), names.leak(), parts.leak()).expect("a sound table")
}

fn text(text: &str) -> &'static str {
    text.to_owned().leak()
}

fn list<A, B>(all: &[A], convert: impl Fn(&A) -> B) -> &'static [B] {
    all.iter().map(convert).collect::<Vec<_>>().leak()
}

#[derive(Clone, Copy)]
struct Table(&'static FormulaTable<'static>);

impl Table {
    fn of(table: &document::Table) -> Self {
        Self(Box::leak(Box::new(self::table(table))))
    }

    fn formula(self, number: Number) -> Formula<'static> {
        self.0.get(number.get()).expect("a number of the table")
    }

    fn formulas(self, all: &[Number]) -> &'static [Formula<'static>] {
        list(all, |number| self.formula(*number))
    }

    fn equation(self, sides: document::Equation) -> Equation<'static> {
        let [left, right] = sides.map(|side| self.formula(side));
        Equation { left, right }
    }

    fn equations(self, all: &[document::Equation]) -> &'static [Equation<'static>] {
        list(all, |equation| self.equation(*equation))
    }

    fn symbol(self, symbol: &document::Symbol) -> Symbol<'static> {
        Symbol { name: text(&symbol.name), formula: self.formula(symbol.formula) }
    }

    fn matrix(self, matrix: &document::Matrix) -> FormulaMatrix<'static> {
        FormulaMatrix {
            name: self.formula(matrix.name),
            factor: matrix.factor.map(|factor| self.formula(factor)),
            rows: matrix.rows,
            columns: matrix.columns,
            entries: list(&matrix.entries, |([row, column], value)| Entry {
                row: *row,
                column: *column,
                value: self.formula(*value),
            }),
        }
    }

    fn group(self, group: &document::Group) -> Group<'static> {
        Group {
            unknowns: self.formulas(&group.unknowns),
            equations: group.equations.clone().leak(),
            kind: text(&group.kind.description()),
            form: match group.kind {
                GroupKind::Rrr => GroupForm::TwoAngles,
                GroupKind::Rrp => GroupForm::AngleAndLength,
                GroupKind::Rpr => GroupForm::AngleAndTurningLength,
                GroupKind::Sliders => GroupForm::TwoLengths,
                GroupKind::Circles => GroupForm::TwoDistances,
                GroupKind::LinkToCircle => GroupForm::AngleAndDistance,
                GroupKind::SliderToCircle => GroupForm::LengthAndDistance,
                GroupKind::Angle => GroupForm::OneAngle,
                GroupKind::Linear => GroupForm::OneLinear,
                GroupKind::Scalar | GroupKind::Pair | GroupKind::Loops(_) | GroupKind::Irreducible(..) => {
                    GroupForm::Other
                }
            },
            position: self.equations(&group.position),
            root: group.root.as_ref().map(|root| Root { formula: self.formula(root.formula), branches: root.branches }),
            method: match group.method {
                document::Method::ClosedForm => GroupMethod::ClosedForm,
                document::Method::Factorization => GroupMethod::Factorization,
            },
            determinant: group.determinant.map(|equation| self.equation(equation)),
            inverse: group.inverse.as_ref().map(|inverse| self.matrix(inverse)),
        }
    }

    fn quantity(self, quantity: &document::Quantity) -> Quantity<'static> {
        Quantity {
            name: text(&quantity.name),
            value: self.equations(&quantity.value),
            ratios: self.equations(&quantity.ratios),
            ratio_derivatives: self.equations(&quantity.ratio_derivatives),
            sensitivities: self.equations(&quantity.sensitivities),
        }
    }

    fn kernel(self, document::Kernel { function, operations, code }: &document::Kernel) -> Kernel<'static> {
        let program::Operations { functions, divisions, multiplications, additions } = *operations;
        Kernel {
            function: text(function),
            operations: Operations { functions, divisions, multiplications, additions },
            code: KernelCode {
                steps: self.equations(&code.steps),
                checks: list(&code.checks, |(word, of)| self.check(word, of)),
                results: list(&code.results, |(place, value)| KernelResult {
                    place: text(place),
                    value: self.formula(*value),
                }),
            },
        }
    }

    fn check(self, word: &str, of: &[Number]) -> KernelCheck<'static> {
        let of = self.formulas(of);
        let check = match word {
            "regular" => of.try_into().map(KernelCheck::Regular),
            "nonzero" => of.try_into().map(KernelCheck::Nonzero),
            "positive" => of.try_into().map(KernelCheck::Positive),
            "apart" => of.try_into().map(KernelCheck::Apart),
            "moderate" => of.try_into().map(KernelCheck::Moderate),
            "open" => of.try_into().map(KernelCheck::Open),
            _ => panic!("no check is named {word}"),
        };
        check.expect("the numbers of the check")
    }
}

fn node(node: &Node, names: &mut Vec<&'static str>, all: &mut Vec<i32>) -> FormulaNode {
    let mut named = |name: &str| {
        names.push(text(name));
        u32::try_from(names.len() - 1).expect("a short table")
    };
    let signed = |(is_negative, part): &(bool, Number)| {
        let number = i32::try_from(part.get()).expect("a short table");
        if *is_negative { -number } else { number }
    };
    let mut add = |parts: &[(bool, Number)]| {
        let first = all.len();
        all.extend(parts.iter().map(signed));
        [first, parts.len()].map(|place| u32::try_from(place).expect("a short table"))
    };
    match node {
        Node::Name(name) => FormulaNode::Name(named(name)),
        Node::Rate(name) => FormulaNode::Rate(name.get()),
        Node::Acceleration(name) => FormulaNode::Acceleration(name.get()),
        Node::Ratio(of, by) => FormulaNode::Ratio(of.get(), by.get()),
        Node::RatioDerivative(of, [first, second]) => FormulaNode::RatioDerivative(of.get(), first.get(), second.get()),
        Node::Determinant(matrix) => FormulaNode::Determinant(matrix.get()),
        Node::Inverse(matrix) => FormulaNode::Inverse(matrix.get()),
        Node::Integer(value) => FormulaNode::Integer(*value),
        Node::Decimal(bits) => FormulaNode::Decimal(f64::from_bits(*bits)),
        Node::Pi => FormulaNode::Pi,
        Node::Ellipsis => FormulaNode::Ellipsis,
        Node::Sum(terms) => {
            let [first, count] = add(terms);
            FormulaNode::Sum(first, count)
        }
        Node::Product(factors) => {
            let [first, count] = unsigned(factors, &mut add);
            FormulaNode::Product(first, count)
        }
        Node::Quotient(above, below) => FormulaNode::Quotient(above.get(), below.get()),
        Node::Power(base, exponent) => FormulaNode::Power(base.get(), *exponent),
        Node::Call(function, arguments) => {
            let [first, count] = unsigned(arguments, &mut add);
            FormulaNode::Call(elementary(*function), first, count)
        }
        Node::External(name, order, arguments) => {
            let [first, count] = unsigned(arguments, &mut add);
            FormulaNode::External(named(name), u32::try_from(*order).expect("a low order"), first, count)
        }
        Node::Multiple(one, other) => FormulaNode::Multiple(one.get(), other.get()),
        Node::AtMost(all) => {
            let [first, count] = unsigned(all, &mut add);
            FormulaNode::AtMost(first, count)
        }
        Node::NonZero(inside) => FormulaNode::NonZero(inside.get()),
        Node::Exists(inside) => FormulaNode::Exists(inside.get()),
    }
}

/// Adds parts without signs.
fn unsigned(parts: &[Number], mut add: impl FnMut(&[(bool, Number)]) -> [u32; 2]) -> [u32; 2] {
    add(&parts.iter().map(|part| (false, *part)).collect::<Vec<_>>())
}

fn elementary(function: Function) -> ElementaryFunction {
    match function {
        Function::Sin => ElementaryFunction::Sin,
        Function::Cos => ElementaryFunction::Cos,
        Function::Tan => ElementaryFunction::Tan,
        Function::Asin => ElementaryFunction::Asin,
        Function::Acos => ElementaryFunction::Acos,
        Function::Atan => ElementaryFunction::Atan,
        Function::Atan2 => ElementaryFunction::Atan2,
        Function::Sqrt => ElementaryFunction::Sqrt,
        Function::Abs => ElementaryFunction::Abs,
        Function::Exp => ElementaryFunction::Exp,
        Function::Ln => ElementaryFunction::Ln,
        Function::Hypot => ElementaryFunction::Hypot,
        Function::IfNonzero => ElementaryFunction::IfNonzero,
    }
}
