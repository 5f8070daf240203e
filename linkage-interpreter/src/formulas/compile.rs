//! The formulas over numbers of any kind, from compiled functions to operations on registers. They are straight lines: lists,
//! fields and patterns are resolved here, once.

use std::collections::BTreeMap;

use std::fmt::{self, Display, Formatter};

use linkage_compiler::Lowered;
use linkage_compiler::program::{AnyNumber, Family, Program};
use linkage_ir::code::{Argument, Code, Function, Names, Passed, Pattern, Statement, Value};
use linkage_ir::{Constant as Path, ElementaryFunction, Intrinsic, Number, Slot, ValueId};

use super::{Binary, Constant, Formula, Formulas, Instruction, Range, Register, Unary};

type Translated<T> = Result<T, String>;

/// Something in compiled code that is no formula over numbers of any kind: a mistake of the compiler.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Untranslated {
    function: String,
    what: String,
}

impl Display for Untranslated {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { function, what } = self;
        write!(f, "the code of `{function}` has {what}, which is not run: this is a mistake of the compiler")
    }
}

/// The formulas of a driver that has them.
pub(crate) fn formulas(lowered: &Lowered) -> Result<Option<Formulas>, Untranslated> {
    let Program { any_number: Some(any), signatures, .. } = &lowered.program else { return Ok(None) };
    let of = |name: &str| formula(any, &lowered.program, name, Form::numbers);
    let ranges = match signatures.ranges.is_empty() {
        true => Formula::default(),
        false => formula(any, &lowered.program, "ranged", Form::ranges)?,
    };
    let quantities = [Family::Points, Family::Outputs].into_iter();
    Ok(Some(Formulas {
        residual: of("residual")?,
        jacobian_unknowns: of("jacobian_unknowns")?,
        jacobian_inputs: of("jacobian_inputs")?,
        gamma: of("gamma")?,
        quantities: of("quantities")?,
        ranges,
        names: quantities.flat_map(|family| family.components(signatures)).collect(),
        user_functions: any.user_functions.clone(),
    }))
}

/// A function of `Formulas` by its name.
fn formula<R>(
    any: &AnyNumber<Code>,
    program: &Program<Code>,
    name: &str,
    results: impl FnOnce(Form) -> Translated<R>,
) -> Result<Formula<R>, Untranslated> {
    let untranslated = |what: String| Untranslated { function: name.to_owned(), what };
    let function = any.functions.iter().find(|function| function.name == name);
    let function = function.ok_or_else(|| untranslated("no such name".to_owned()))?;
    let code = function.body.as_ref().ok_or_else(|| untranslated("no body".to_owned()))?;
    let mut line = Line::of(code, function, program);
    let results = line.value_of(code).and_then(results).map_err(untranslated)?;
    Ok(Formula { instructions: line.instructions, results })
}

/// A value of a function.
#[derive(Debug, Clone)]
enum Form {
    Number(Register),
    List(Vec<Form>),
    Absent,
    /// The mechanism.
    Itself,
    /// The argument that says which of several values is wanted.
    Place,
    Range(Range),
}

impl Form {
    fn number(self) -> Translated<Register> {
        if let Self::Number(register) = self { Ok(register) } else { Err(format!("{self:?} in place of a number")) }
    }

    fn perhaps(self) -> Translated<Option<Register>> {
        if let Self::Absent = self { Ok(None) } else { self.number().map(Some) }
    }

    fn list(self) -> Translated<Vec<Self>> {
        if let Self::List(all) = self { Ok(all) } else { Err(format!("{self:?} in place of a list")) }
    }

    /// All numbers, of columns one after the other.
    fn numbers(self) -> Translated<Vec<Register>> {
        match self {
            Self::List(all) => {
                all.into_iter().map(Self::numbers).collect::<Translated<Vec<_>>>().map(|all| all.concat())
            }
            other => other.number().map(|number| vec![number]),
        }
    }

    fn ranges(self) -> Translated<Vec<Range>> {
        let range = |form| if let Self::Range(range) = form { Ok(range) } else { Err(format!("{form:?} as a range")) };
        self.list()?.into_iter().map(range).collect()
    }
}

/// The translation of a function.
struct Line<'l> {
    code: &'l Code,
    names: &'l Names,
    parameters: BTreeMap<&'l str, Register>,
    /// `self`, the arguments, and what statements bind.
    bound: BTreeMap<Slot, Form>,
    done: BTreeMap<ValueId, Form>,
    instructions: Vec<Instruction>,
    /// The next register.
    next: u32,
}

impl<'l> Line<'l> {
    fn of(code: &'l Code, function: &Function, program: &'l Program<Code>) -> Self {
        let Program { signatures, names, .. } = program;
        let mut next = 0;
        let mut given = || {
            next += 1;
            Register(next - 1)
        };
        let fields = signatures.parameters.iter().map(|parameter| parameter.name.field.as_str());
        let parameters = fields.map(|field| (field, given())).collect();
        // Unknowns and inputs, or these and their rates.
        let mut counts = [signatures.unknowns.len(), signatures.inputs.len()].into_iter().cycle();
        let mut argument = |of: &Argument| match of.passed {
            Passed::ByValue(_) => Form::Place,
            _ => Form::List((0..counts.next().unwrap_or_default()).map(|_| Form::Number(given())).collect()),
        };
        let arguments = function.arguments.iter().map(&mut argument).collect::<Vec<_>>();
        let arguments = arguments.into_iter().enumerate().map(|(place, form)| (Slot::of_argument(place), form));
        let bound = arguments.chain([(Slot::ITSELF, Form::Itself)]).collect();
        Self { code, names, parameters, bound, done: BTreeMap::new(), instructions: Vec::new(), next }
    }

    /// Translates the statements and the value.
    fn value_of(&mut self, code: &Code) -> Translated<Form> {
        for statement in &code.statements {
            let Statement::Let(pattern, value) = statement else { return Err(format!("{statement:?}")) };
            let form = self.value(*value)?;
            self.bind(pattern, form)?;
        }
        self.value(code.value.literal())
    }

    fn bind(&mut self, pattern: &Pattern, form: Form) -> Translated<()> {
        match pattern {
            Pattern::Bound(bound) | Pattern::Mutable(bound) | Pattern::Typed(bound, _) => {
                self.bound.insert(*bound, form);
                Ok(())
            }
            Pattern::Ignored => Ok(()),
            Pattern::List(all) | Pattern::Tuple(all) => {
                let forms = form.list()?;
                if forms.len() != all.len() {
                    return Err("a list of another length".to_owned());
                }
                all.iter().zip(forms).try_for_each(|(pattern, form)| self.bind(pattern, form))
            }
            Pattern::Struct { fields, .. } => {
                let Form::Itself = form else { return Err(format!("fields of {form:?}")) };
                fields.iter().try_for_each(|(name, pattern)| {
                    let parameter = Form::Number(self.parameter(self.names.text(*name))?);
                    self.bind(pattern, parameter)
                })
            }
            Pattern::Case(..) => Err("a pattern that may not match".to_owned()),
        }
    }

    fn parameter(&self, name: &str) -> Translated<Register> {
        self.parameters.get(name).copied().ok_or_else(|| format!("no parameter `{name}`"))
    }

    fn number(&mut self, id: ValueId) -> Translated<Register> {
        self.value(id)?.number()
    }

    /// A value by its slot, or computed where it is used.
    fn value(&mut self, id: ValueId) -> Translated<Form> {
        if let Value::Given(slot) = self.code.operation(id) {
            return self.bound.get(slot).cloned().ok_or_else(|| format!("{slot:?} before it is bound"));
        }
        if let Some(done) = self.done.get(&id) {
            return Ok(done.clone());
        }
        let form = self.operation(id)?;
        self.done.insert(id, form.clone());
        Ok(form)
    }

    fn add(&mut self, instruction: Instruction) -> Register {
        let register = Register(self.next);
        self.next += instruction.writes();
        self.instructions.push(instruction);
        register
    }

    fn unary(&mut self, function: Unary, of: Register) -> Register {
        self.add(Instruction::Unary(function, of))
    }

    fn binary(&mut self, function: Binary, one: Register, other: Register) -> Register {
        self.add(Instruction::Binary(function, one, other))
    }

    fn constant(&mut self, constant: Constant) -> Register {
        self.add(Instruction::Constant(constant))
    }

    fn operation(&mut self, id: ValueId) -> Translated<Form> {
        let code = self.code;
        let number = match code.operation(id) {
            Value::Constant(number) if number.is_zero() => self.constant(Constant::Zero),
            Value::Constant(Number::Ratio(1, 1)) => self.constant(Constant::One),
            Value::Exact(number) => self.exact(*number, false),
            Value::Sum(terms) => {
                let mut terms = terms.iter();
                let first = terms.next().ok_or_else(|| "a sum of nothing".to_owned())?;
                let mut sum = if first.negative { self.negative(first.value)? } else { self.number(first.value)? };
                for term in terms {
                    let function = if term.negative { Binary::Minus } else { Binary::Plus };
                    let term = self.number(term.value)?;
                    sum = self.binary(function, sum, term);
                }
                sum
            }
            Value::Product(factors) => {
                let (first, others) = factors.split_first().ok_or_else(|| "a product of nothing".to_owned())?;
                let first = self.number(*first)?;
                self.product(first, others)?
            }
            Value::Quotient(above, below) => {
                let (above, below) = (self.number(*above)?, self.number(*below)?);
                self.binary(Binary::Over, above, below)
            }
            Value::Square(base) => {
                let base = self.number(*base)?;
                self.binary(Binary::Times, base, base)
            }
            Value::Negative(inside) => self.negative(*inside)?,
            Value::Call(function, arguments) => {
                let arguments = arguments.iter().map(|argument| match argument.negative {
                    true => self.negative(argument.value),
                    false => self.number(argument.value),
                });
                let arguments = arguments.collect::<Translated<Vec<_>>>()?;
                self.call(*function, &arguments)?
            }
            Value::Intrinsic(of, _, arguments) => return self.intrinsic(*of, arguments),
            Value::List(all) | Value::Tuple(all) => {
                let all = all.iter().map(|value| self.value(*value)).collect::<Translated<_>>()?;
                return Ok(Form::List(all));
            }
            Value::Field(of, name) if matches!(code.operation(*of), Value::Given(Slot::ITSELF)) => {
                self.parameter(self.names.text(*name))?
            }
            Value::Repeated(value, count) => return Ok(Form::List(vec![self.value(*value)?; *count])),
            Value::Path(Path::None) => return Ok(Form::Absent),
            Value::Borrowed(of) | Value::Dereferenced(of) => return self.value(*of),
            other => return Err(format!("{other:?}")),
        };
        Ok(Form::Number(number))
    }

    fn product(&mut self, first: Register, others: &[ValueId]) -> Translated<Register> {
        others.iter().try_fold(first, |product, factor| {
            let factor = self.number(*factor)?;
            Ok(self.binary(Binary::Times, product, factor))
        })
    }

    /// The negative of a value as emitted code computes it: `-a * b` is (-a)*b.
    fn negative(&mut self, id: ValueId) -> Translated<Register> {
        let code = self.code;
        match code.operation(id) {
            Value::Product(factors) => {
                let (first, others) = factors.split_first().ok_or_else(|| "a product of nothing".to_owned())?;
                let first = self.negative(*first)?;
                self.product(first, others)
            }
            Value::Square(base) => {
                let (first, second) = (self.negative(*base)?, self.number(*base)?);
                Ok(self.binary(Binary::Times, first, second))
            }
            Value::Quotient(above, below) => {
                let (above, below) = (self.negative(*above)?, self.number(*below)?);
                Ok(self.binary(Binary::Over, above, below))
            }
            Value::Exact(number) => Ok(self.exact(*number, true)),
            // Two signs are none.
            Value::Negative(inside) => self.number(*inside),
            _ => {
                let inside = self.number(id)?;
                Ok(self.unary(Unary::Negative, inside))
            }
        }
    }

    /// A constant as emitted code writes it, or its negative.
    fn exact(&mut self, number: Number, is_negative: bool) -> Register {
        let signed = |line: &mut Self, constant| match line.constant(constant) {
            register if is_negative => line.unary(Unary::Negative, register),
            register => register,
        };
        match (number, number.as_quotient()) {
            // Dividing a double by a power of two is exact.
            (Number::Ratio(_, parts), Some([above, below])) if parts.count_ones() == 1 => {
                signed(self, Constant::Exactly(above / below))
            }
            (_, Some([above, below])) => signed(self, Constant::Ratio(above, below)),
            (Number::Ratio(above, below), None) if below != 1 => {
                let above = signed(self, Constant::Near(above as f64));
                let below = self.constant(Constant::Near(below as f64));
                self.binary(Binary::Over, above, below)
            }
            _ => signed(self, Constant::Near(number.to_f64())),
        }
    }

    fn call(&mut self, function: ElementaryFunction, arguments: &[Register]) -> Translated<Register> {
        match (function, arguments) {
            (ElementaryFunction::IfNonzero, _) => Err("a comparison".to_owned()),
            (_, &[of]) => Ok(self.add(Instruction::Of(function, of))),
            (_, &[one, other]) => Ok(self.add(Instruction::OfTwo(function, one, other))),
            _ => Err(format!("{function:?} of {arguments:?}")),
        }
    }

    fn sine_cosine(&mut self, angle: Register) -> Form {
        let sine = self.add(Instruction::SineCosine(angle));
        Form::List(vec![Form::Number(sine), Form::Number(Register(sine.0 + 1))])
    }

    fn intrinsic(&mut self, of: Intrinsic, arguments: &[ValueId]) -> Translated<Form> {
        let form = match (of, arguments) {
            // The value itself.
            (Intrinsic::From | Intrinsic::Into | Intrinsic::Copied | Intrinsic::Some, [value]) => self.value(*value)?,
            (Intrinsic::Pi, []) => Form::Number(self.constant(Constant::Pi)),
            (Intrinsic::Unknown, []) => Form::Number(self.constant(Constant::Unknown)),
            (Intrinsic::Square, [base]) => {
                let base = self.number(*base)?;
                Form::Number(self.unary(Unary::Square, base))
            }
            (Intrinsic::SineCosine, [angle]) => {
                let angle = self.number(*angle)?;
                self.sine_cosine(angle)
            }
            (Intrinsic::SinesCosines, [angles]) => {
                let angles = self.value(*angles)?.list()?.into_iter();
                let pair = |angle: Form| Ok(self.sine_cosine(angle.number()?));
                Form::List(angles.map(pair).collect::<Translated<_>>()?)
            }
            (Intrinsic::Ranged | Intrinsic::RangedModuloTurns, [value, least, most]) => {
                let value = self.number(*value)?;
                let (least, most) = (self.value(*least)?.perhaps()?, self.value(*most)?.perhaps()?);
                Form::Range(Range { value, least, most, is_direction: of == Intrinsic::RangedModuloTurns })
            }
            (Intrinsic::Get, [list, place]) => match self.value(*place)? {
                // All of them: the runtime chooses one.
                Form::Place => self.value(*list)?,
                other => return Err(format!("the entry {other:?}")),
            },
            (other, _) => return Err(format!("{other:?} over numbers of any kind")),
        };
        Ok(form)
    }
}
