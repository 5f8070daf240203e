//! From the compiler's lowered functions to those that are run: names become numbers, types are resolved.

mod formulas;
mod intrinsics;
mod types;

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use linkage_compiler::graph::{self, Number};
use linkage_compiler::ids::Id as _;
use linkage_compiler::lower::{self, Code, Returned as Lowered, ValueId};
use linkage_compiler::program::{self, Constant as Path, Passed, Receiver, Type as TypeOf, TypeNames};
use linkage_compiler::text::Message;

pub(crate) use formulas::formulas;

use crate::code::{
    Access, Argument, Block, Constant, Expression, Function, Id, Name, Names, Pattern, Place, Returned, Shape, Slot,
    Statement,
};

/// The things that the functions of a driver or a scene refer to.
pub(crate) struct Context<'c> {
    pub(crate) types: &'c TypeNames,
    pub(crate) points: Vec<String>,
    pub(crate) outputs: Vec<String>,
    /// The functions of the type itself, by id: their places.
    pub(crate) own: Vec<Option<usize>>,
    /// Those of the driver.
    pub(crate) of_driver: Vec<Option<usize>>,
    /// The functions of poses and branches by name: their places.
    pub(crate) of_pose: Vec<String>,
    pub(crate) of_branch: Vec<String>,
    /// The user functions by id: their places.
    pub(crate) users: BTreeMap<graph::ExternalId, usize>,
}

/// Something in lowered code that has no meaning for the interpreter: a mistake of the compiler.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Untranslated {
    pub(crate) function: String,
    pub(crate) what: String,
}

impl Display for Untranslated {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { function, what } = self;
        write!(f, "the code of `{function}` has {what}, which is not run: this is a mistake of the compiler")
    }
}

/// A message about a text as a whole.
pub(crate) fn without_place(text: String) -> Message {
    Message { line: 1, column: 1, length: 0, text, help: None }
}

impl Context<'_> {
    /// Translates a function with a body.
    pub(crate) fn function(&self, of: &program::Function<Code>, names: &mut Names) -> Result<Function, Untranslated> {
        let untranslated = |what: String| Untranslated { function: of.name.clone(), what };
        let code = of.body.as_ref().ok_or_else(|| untranslated("no body".to_owned()))?;
        let mut translator = Translator {
            context: self,
            code,
            names,
            slots: BTreeMap::new(),
            // `self` and the arguments have the first slots.
            next: 1 + of.arguments.len() as u32,
            done: BTreeMap::new(),
            expressions: Vec::new(),
        };
        let body = translator.body().map_err(untranslated)?;
        let (slots, expressions) = (translator.next, translator.expressions);
        let (statements, value) = body;
        let arguments = of.arguments.iter().map(|argument| Argument {
            name: argument.name.clone(),
            shape: match &argument.passed {
                Passed::ByValue(of)
                | Passed::ByReference(of)
                | Passed::ByMutableReference(of)
                | Passed::Converted(of) => self.shape(of),
                Passed::Turns => Shape::Other("turns".to_owned()),
            },
        });
        Ok(Function {
            name: of.name.clone(),
            access: match of.access {
                access if access.is_public() => Access::Public,
                program::Access::OfTrait => Access::OfTrait,
                _ => Access::Private,
            },
            is_method: of.is_method,
            is_fallible: of.is_fallible,
            arguments: arguments.collect(),
            returns: self.shape(&of.returns),
            slots,
            expressions,
            statements,
            value,
        })
    }
}

/// The translation of one function.
struct Translator<'t> {
    context: &'t Context<'t>,
    code: &'t Code,
    names: &'t mut Names,
    /// The slots of values that statements bind.
    slots: BTreeMap<ValueId, Slot>,
    next: u32,
    /// The expressions of values that are computed where they are used.
    done: BTreeMap<ValueId, Id>,
    expressions: Vec<Expression>,
}

type Translated<T> = Result<T, String>;

impl Translator<'_> {
    fn body(&mut self) -> Translated<(Vec<Statement>, Returned)> {
        let stored = match self.code.value {
            Lowered::Stored { result, .. } => Some(result),
            _ => None,
        };
        let statements = self.code.statements.iter().filter(|statement| !is_store(self.code, statement, stored));
        let statements = statements.map(|statement| self.statement(statement)).collect::<Translated<Vec<_>>>()?;
        let value = self.value(self.code.value.literal())?;
        let value = match self.code.value {
            Lowered::Result(_) => Returned::Outcome(value),
            Lowered::Plain(_) | Lowered::Stored { .. } => Returned::Plain(value),
        };
        Ok((statements, value))
    }

    fn statements(&mut self, all: &[lower::Statement]) -> Translated<Vec<Statement>> {
        all.iter().map(|statement| self.statement(statement)).collect()
    }

    fn statement(&mut self, statement: &lower::Statement) -> Translated<Statement> {
        Ok(match statement {
            lower::Statement::Let(pattern, value) => {
                let value = match pattern {
                    // The pattern gives the value its name.
                    lower::Pattern::Bound(bound) if bound == value => self.computed(*value)?,
                    _ => self.value(*value)?,
                };
                Statement::Let(self.pattern(pattern), value)
            }
            lower::Statement::Do(value) => Statement::Do(self.value(*value)?),
            lower::Statement::Assign(to, value) => Statement::Assign(self.place(*to)?, self.value(*value)?),
            lower::Statement::Return(value) => Statement::Return(self.value(*value)?),
            lower::Statement::LetElse(pattern, value, otherwise) => {
                let (value, otherwise) = (self.value(*value)?, self.value(*otherwise)?);
                Statement::LetElse(self.pattern(pattern), value, otherwise)
            }
            lower::Statement::Unless(conditions, inside) => {
                Statement::Unless(self.values(conditions)?, self.statements(inside)?)
            }
        })
    }

    /// A part of a bound value that is replaced.
    fn place(&mut self, id: ValueId) -> Translated<Place> {
        if self.code.name(id).is_some() {
            return Ok(Place { of: self.slot(id), at: Vec::new() });
        }
        let (of, at) = match self.code.operation(id) {
            lower::Value::Index(of, index) => (*of, self.add(Expression::Count(*index))),
            lower::Value::At(of, index) => (*of, self.value(*index)?),
            other => return Err(format!("a place {other:?}")),
        };
        let mut place = self.place(of)?;
        place.at.push(at);
        Ok(place)
    }

    fn pattern(&mut self, pattern: &lower::Pattern) -> Pattern {
        match pattern {
            lower::Pattern::Bound(bound) | lower::Pattern::Mutable(bound) | lower::Pattern::Typed(bound, _) => {
                Pattern::Bound(self.slot(*bound))
            }
            lower::Pattern::Case(_, inside) => Pattern::Present(Box::new(self.pattern(inside))),
            lower::Pattern::Ignored => Pattern::Ignored,
            lower::Pattern::List(all) | lower::Pattern::Tuple(all) => {
                Pattern::List(all.iter().map(|pattern| self.pattern(pattern)).collect())
            }
            lower::Pattern::Struct { fields, .. } => {
                let fields = fields.iter().map(|(name, pattern)| (self.names.of(name), self.pattern(pattern)));
                Pattern::Record(fields.collect())
            }
        }
    }

    /// The slot of a value with a name: an argument, or what a statement binds.
    fn slot(&mut self, id: ValueId) -> Slot {
        match self.code.operation(id) {
            lower::Value::Itself => Slot(0),
            lower::Value::Argument(index) => Slot(1 + *index as u32),
            _ => *self.slots.entry(id).or_insert_with(|| {
                self.next += 1;
                Slot(self.next - 1)
            }),
        }
    }

    fn add(&mut self, expression: Expression) -> Id {
        self.expressions.push(expression);
        Id(self.expressions.len() as u32 - 1)
    }

    fn values(&mut self, ids: &[ValueId]) -> Translated<Vec<Id>> {
        ids.iter().map(|id| self.value(*id)).collect()
    }

    /// A value by its slot, or computed where it is used.
    fn value(&mut self, id: ValueId) -> Translated<Id> {
        if self.code.name(id).is_some() {
            let slot = self.slot(id);
            return Ok(self.add(Expression::Slot(slot)));
        }
        self.computed(id)
    }

    /// The operation of a value.
    fn computed(&mut self, id: ValueId) -> Translated<Id> {
        if let Some(done) = self.done.get(&id) {
            return Ok(*done);
        }
        let done = self.operation(id)?;
        self.done.insert(id, done);
        Ok(done)
    }

    fn operation(&mut self, id: ValueId) -> Translated<Id> {
        let code = self.code;
        let expression = match code.operation(id) {
            lower::Value::Constant(number) => Expression::Number(constant(*number)),
            lower::Value::Sum(terms) => {
                let term = |(place, term): (usize, &lower::Signed)| match (place, term.negative) {
                    (0, true) => Ok((false, self.negative(term.value)?)),
                    (_, is_negative) => Ok((is_negative, self.value(term.value)?)),
                };
                Expression::Sum(terms.iter().enumerate().map(term).collect::<Translated<_>>()?)
            }
            lower::Value::Product(factors) => Expression::Product(self.values(factors)?),
            lower::Value::Quotient(above, below) => Expression::Quotient(self.value(*above)?, self.value(*below)?),
            lower::Value::Square(base) => Expression::Square(self.value(*base)?),
            lower::Value::Negative(inside) => return self.negative(*inside),
            lower::Value::Call(function, arguments) => {
                let arguments = arguments.iter().map(|argument| match argument.negative {
                    true => self.negative(argument.value),
                    false => self.value(argument.value),
                });
                let arguments = arguments.collect::<Translated<_>>()?;
                Expression::Call(*function, arguments)
            }
            lower::Value::All(conditions) => Expression::All(self.values(conditions)?),
            lower::Value::Text(text) => Expression::Text(text.as_str().into()),
            lower::Value::Count(count) => Expression::Count(*count),
            lower::Value::Path(path) => self.path(*path),
            lower::Value::Field(of, name) => match (code.operation(*of), name.as_str()) {
                // The columns of a matrix, `matrix.data.0`.
                (lower::Value::Field(matrix, data), "0") if data == "data" => return self.value(*matrix),
                _ => {
                    let of = self.value(*of)?;
                    match name.parse() {
                        // An entry of a tuple.
                        Ok(index) => Expression::Index(of, index),
                        Err(_) => Expression::Field(of, self.names.of(name)),
                    }
                }
            },
            lower::Value::Index(of, index) => Expression::Index(self.value(*of)?, *index),
            lower::Value::At(of, index) => Expression::At(self.value(*of)?, self.value(*index)?),
            lower::Value::List(values) | lower::Value::Tuple(values) => Expression::List(self.values(values)?),
            lower::Value::Repeated(value, count) => Expression::Repeated(self.value(*value)?, *count),
            lower::Value::Struct(of, members, rest) => {
                let mut fields = Vec::with_capacity(members.len());
                for (name, value) in members {
                    if !self.is_mark(*value) {
                        fields.push((self.names.of(name), self.value(*value)?));
                    }
                }
                let rest = rest.map(|rest| self.value(rest)).transpose()?;
                Expression::Record(self.type_name(of), fields, rest)
            }
            lower::Value::Intrinsic(of, of_type, arguments) => {
                return self.intrinsic(*of, of_type.as_ref(), arguments);
            }
            // A function as an argument: what takes it knows it.
            lower::Value::Function(..) => Expression::Absent,
            lower::Value::Own(receiver, function, arguments) => {
                let arguments = self.values(arguments)?;
                let place = |all: &[Option<usize>]| {
                    all.get(function.index()).copied().flatten().ok_or_else(|| format!("a call of {function:?}"))
                };
                match receiver {
                    Receiver::Itself | Receiver::ItsType => Expression::Own(place(&self.context.own)?, arguments),
                    Receiver::Value(of) => {
                        let of = self.value(*of)?;
                        Expression::OfMechanism(Some(of), place(&self.context.of_driver)?, arguments)
                    }
                    Receiver::Type(_) => Expression::OfMechanism(None, place(&self.context.of_driver)?, arguments),
                }
            }
            lower::Value::UserFunction(function, arguments) => {
                let place = self.context.users.get(function);
                let place = *place.ok_or_else(|| format!("a call of {function:?}"))?;
                Expression::User(place, self.values(arguments)?)
            }
            lower::Value::Try(value) => Expression::Try(self.value(*value)?),
            // Values have no places but those of `Assign`.
            lower::Value::Borrowed(of) | lower::Value::MutablyBorrowed(of) | lower::Value::Dereferenced(of) => {
                return self.value(*of);
            }
            lower::Value::Closure { arguments, body, .. } => {
                let arguments = arguments.iter().map(|argument| self.pattern(argument)).collect();
                Expression::Closure(arguments, self.block(body)?)
            }
            lower::Value::Block(block) => Expression::Block(self.block(block)?),
            other @ (lower::Value::Symbol(_)
            | lower::Value::Direction(..)
            | lower::Value::Bound
            | lower::Value::Itself
            | lower::Value::Argument(_)
            | lower::Value::Exact(_)
            | lower::Value::External(..)) => return Err(format!("{other:?}")),
        };
        Ok(self.add(expression))
    }

    /// The negative of a value as emitted code computes it: `-a * b` is (-a)*b. In twice the precision a product that is zero
    /// can have another sign than -(a*b).
    fn negative(&mut self, id: ValueId) -> Translated<Id> {
        let code = self.code;
        let of = code.name(id).is_none().then(|| code.operation(id));
        let expression = match of {
            Some(lower::Value::Product(factors)) => {
                let factors = factors.iter().enumerate().map(|(place, factor)| match place {
                    0 => self.negative(*factor),
                    _ => self.value(*factor),
                });
                Expression::Product(factors.collect::<Translated<_>>()?)
            }
            Some(lower::Value::Square(base)) => Expression::Product(vec![self.negative(*base)?, self.value(*base)?]),
            Some(lower::Value::Quotient(above, below)) => {
                Expression::Quotient(self.negative(*above)?, self.value(*below)?)
            }
            // Two signs are none.
            Some(lower::Value::Negative(inside)) => return self.value(*inside),
            _ => Expression::Negative(self.value(id)?),
        };
        Ok(self.add(expression))
    }

    fn block(&mut self, block: &lower::Block) -> Translated<Block> {
        Ok(Block { statements: self.statements(&block.statements)?, value: self.value(block.value)? })
    }

    /// True for the mark that stands for the scalar of a type without numbers.
    fn is_mark(&self, id: ValueId) -> bool {
        matches!(self.code.operation(id), lower::Value::Path(Path::Mark))
    }

    fn type_name(&mut self, of: &TypeOf) -> Name {
        let context = self.context;
        let text = match of {
            TypeOf::Own(name) | TypeOf::Wide(name) | TypeOf::Bare(name) | TypeOf::Each(name, _) => name.as_str(),
            TypeOf::Runtime(name, _) | TypeOf::Sized(name, _) | TypeOf::Around(name, _) => name,
            // Of the functions of other types only that of a branch makes values of its own type.
            TypeOf::Itself => context.types.branch.as_str(),
            _ => "",
        };
        self.names.of(text)
    }

    fn path(&mut self, of: Path) -> Expression {
        match of {
            Path::Name => Expression::OwnName,
            Path::False => Expression::Flag(false),
            Path::Quantities => Expression::Quantities,
            of_runtime => Expression::OfRuntime(of_runtime),
        }
    }
}

/// True for the statements that store members of the returned literal as they become known: the literal has them too.
fn is_store(code: &Code, statement: &lower::Statement, stored: Option<ValueId>) -> bool {
    let Some(result) = stored else { return false };
    match statement {
        lower::Statement::Let(lower::Pattern::Mutable(bound), _) => *bound == result,
        lower::Statement::LetElse(_, value, otherwise) => {
            *otherwise == result && matches!(code.operation(*value), lower::Value::MutablyBorrowed(of) if *of == result)
        }
        lower::Statement::Assign(..) => true,
        _ => false,
    }
}

/// A constant as emitted code writes it.
fn constant(number: Number) -> Constant {
    if let Some((count, parts)) = linkage_compiler::emit::parts_of_pi(number) {
        return Constant::Turn(count, parts);
    }
    Constant::Double(match number {
        Number::Ratio(above, below) => above as f64 / below as f64,
        // Emitted code writes zero without its sign.
        Number::Float(0.0) => 0.0,
        Number::Float(value) => value,
    })
}
