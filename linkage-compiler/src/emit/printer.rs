//! The printer of lowered code: one order of visits and one rule of precedence for all styles.

use linkage_ir::code::{Block, Called, Callee, Code, Names, Pattern, Signed, Statement, Value};
use linkage_ir::{Slot, ValueId};

use crate::graph::{Function, Number};
use crate::program::{Constant, Form, Intrinsic, Receiver, Type};

/// The precedence of an expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

/// The callee of a call as a style writes it: on a value, on a type, on a reference to a value by the path of the trait
/// `Mechanism`, or in the runtime.
pub(super) enum On<T> {
    Value(T),
    Type(Type),
    Mechanism(T),
    Runtime,
}

/// A member of a struct: its name and its value, `None` for a variable of this name.
pub(super) type Member<T> = (String, Option<T>);

/// The notation of lowered code.
pub(super) trait Style {
    type Text;

    fn brackets(&self, inside: Self::Text) -> Self::Text;
    fn name(&self, name: &str) -> Self::Text;
    fn number(&self, number: Number) -> Self::Text;
    /// A multiple of pi, and its precedence.
    fn turn(&self, number: Number, count: i32, parts: u32) -> Self::Text;
    fn turn_binding(&self) -> Binding;
    fn exact(&self, number: Number) -> Self::Text;
    fn exact_binding(&self, number: Number) -> Binding;
    /// The terms, each with true if it is subtracted.
    fn sum(&self, terms: Vec<(bool, Self::Text)>) -> Self::Text;
    fn product(&self, factors: Vec<Self::Text>) -> Self::Text;
    fn quotient(&self, above: Self::Text, below: Self::Text) -> Self::Text;
    /// The square of a base that is written as a first factor and as a later one.
    fn square(&self, first: Self::Text, later: Self::Text) -> Self::Text;
    fn square_binding(&self) -> Binding;
    fn negative(&self, inside: Self::Text) -> Self::Text;
    /// The first argument of an elementary function, which binds like this.
    fn argument(&self, binding: Binding, first: Self::Text) -> Self::Text;
    /// An elementary function of its first argument and others.
    fn elementary(&self, function: Function, first: Option<Self::Text>, others: Vec<Self::Text>) -> Self::Text;
    fn all(&self, conditions: Vec<Self::Text>) -> Self::Text;

    fn text(&self, text: &str) -> Self::Text;
    fn count(&self, count: usize) -> Self::Text;
    fn constant(&self, constant: Constant) -> Self::Text;
    fn field(&self, of: Self::Text, name: &str) -> Self::Text;
    fn index(&self, of: Self::Text, index: usize) -> Self::Text;
    fn entry(&self, of: Self::Text, index: Self::Text) -> Self::Text;
    fn list(&self, values: Vec<Self::Text>) -> Self::Text;
    fn repeated(&self, value: Self::Text, count: usize) -> Self::Text;
    fn tuple(&self, values: Vec<Self::Text>) -> Self::Text;
    fn structure(&self, of: &Type, members: Vec<Member<Self::Text>>, rest: Option<Self::Text>) -> Self::Text;

    fn call(&self, on: On<Self::Text>, name: &str, arguments: Vec<Self::Text>) -> Self::Text;
    fn function(&self, of: Option<&Type>, name: &str) -> Self::Text;
    fn tried(&self, value: Self::Text) -> Self::Text;
    fn borrowed(&self, value: Self::Text) -> Self::Text;
    fn mutably_borrowed(&self, value: Self::Text) -> Self::Text;
    fn dereferenced(&self, value: Self::Text) -> Self::Text;
    /// The precedence of a reference to a value, or of the value behind one, with that of the value.
    fn reference_binding(&self, of: Binding) -> Binding;
    fn closure(
        &self,
        arguments: Vec<Self::Text>,
        statements: Vec<Self::Text>,
        value: Self::Text,
        moves: bool,
    ) -> Self::Text;
    /// A block; without a value it ends with its statements.
    fn block(&self, statements: Vec<Self::Text>, value: Option<Self::Text>) -> Self::Text;

    fn let_statement(&self, pattern: Self::Text, value: Self::Text) -> Self::Text;
    fn do_statement(&self, value: Self::Text) -> Self::Text;
    fn assignment(&self, to: Self::Text, value: Self::Text) -> Self::Text;
    fn return_statement(&self, value: Self::Text) -> Self::Text;
    fn let_else(&self, pattern: Self::Text, value: Self::Text, otherwise: Self::Text) -> Self::Text;
    fn unless(&self, conditions: Vec<Self::Text>, inside: Vec<Self::Text>) -> Self::Text;

    fn ignored(&self) -> Self::Text;
    fn mutable(&self, name: Self::Text) -> Self::Text;
    fn case(&self, case: Intrinsic, inside: Self::Text) -> Self::Text;
    fn typed(&self, name: Self::Text, of: &Type) -> Self::Text;
    fn struct_pattern(&self, of: &Type, fields: Vec<Member<Self::Text>>, is_whole: bool) -> Self::Text;
}

/// The code of a function in a style.
pub(super) struct Printer<'c, S> {
    pub(super) code: &'c Code,
    pub(super) names: &'c Names,
    pub(super) style: S,
}

impl<S: Style> Printer<'_, S> {
    pub(super) fn statements(&self, statements: &[Statement]) -> Vec<S::Text> {
        statements.iter().map(|statement| self.statement(statement)).collect()
    }

    fn statement(&self, statement: &Statement) -> S::Text {
        match statement {
            Statement::Let(pattern, value) => self.style.let_statement(self.pattern(pattern), self.value(*value)),
            Statement::Do(value) => self.style.do_statement(self.value(*value)),
            Statement::Assign(to, value) => self.style.assignment(self.value(*to), self.value(*value)),
            Statement::Return(value) => self.style.return_statement(self.value(*value)),
            Statement::LetElse(pattern, value, otherwise) => {
                self.style.let_else(self.pattern(pattern), self.value(*value), self.value(*otherwise))
            }
            Statement::Unless(conditions, inside) => {
                self.style.unless(self.values(conditions), self.statements(inside))
            }
            Statement::Store(inside) => self.statement(inside),
        }
    }

    fn pattern(&self, pattern: &Pattern) -> S::Text {
        let all = |patterns: &[Pattern]| patterns.iter().map(|pattern| self.pattern(pattern)).collect();
        match pattern {
            Pattern::Bound(bound) => self.name(*bound),
            Pattern::Mutable(bound) => self.style.mutable(self.name(*bound)),
            Pattern::Typed(bound, of) => self.style.typed(self.name(*bound), of),
            Pattern::Case(case, inside) => self.style.case(*case, self.pattern(inside)),
            Pattern::Ignored => self.style.ignored(),
            Pattern::List(patterns) => self.style.list(all(patterns)),
            Pattern::Tuple(patterns) => self.style.tuple(all(patterns)),
            Pattern::Struct { of, fields, is_whole } => {
                let fields = fields.iter().map(|(field, pattern)| {
                    let field = self.names.text(*field);
                    let is_name = matches!(pattern, Pattern::Bound(bound) if self.code.name(*bound) == field);
                    (field.to_owned(), (!is_name).then(|| self.pattern(pattern)))
                });
                self.style.struct_pattern(of, fields.collect(), *is_whole)
            }
        }
    }

    fn values(&self, values: &[ValueId]) -> Vec<S::Text> {
        values.iter().map(|value| self.value(*value)).collect()
    }

    fn name(&self, slot: Slot) -> S::Text {
        self.style.name(self.code.name(slot))
    }

    /// A value in brackets if it binds less tightly than `at_least`.
    fn operand(&self, id: ValueId, at_least: Binding) -> S::Text {
        let text = self.value(id);
        if self.binding(id) < at_least { self.style.brackets(text) } else { text }
    }

    fn binding(&self, id: ValueId) -> Binding {
        match self.code.operation(id) {
            Value::Sum(_) | Value::All(_) | Value::Closure { .. } => Binding::Sum,
            Value::Product(_) | Value::Quotient(..) => Binding::Product,
            Value::Square(_) => self.style.square_binding(),
            Value::Turn(..) => self.style.turn_binding(),
            Value::Exact(number) => self.style.exact_binding(*number),
            // -a * b parses as (-a) * b, which is equal but for the sign of a zero in twice the precision, and costs the same.
            Value::Negative(inside) => match self.binding(*inside) {
                Binding::Product => Binding::Product,
                _ => Binding::Prefix,
            },
            Value::Borrowed(of) | Value::MutablyBorrowed(of) | Value::Dereferenced(of) => {
                self.style.reference_binding(self.binding(*of))
            }
            _ => Binding::Atom,
        }
    }

    /// A value by its name, or computed where it is used.
    pub(super) fn value(&self, id: ValueId) -> S::Text {
        let style = &self.style;
        match self.code.operation(id) {
            Value::Given(slot) => self.name(*slot),
            Value::Constant(number) => style.number(*number),
            Value::Turn(number, count, parts) => style.turn(*number, *count, *parts),
            Value::Exact(number) => style.exact(*number),
            Value::Sum(terms) => {
                let term = |(index, term): (usize, &Signed)| {
                    let least = if index == 0 && !term.negative { Binding::Sum } else { Binding::Product };
                    (term.negative, self.operand(term.value, least))
                };
                style.sum(terms.iter().enumerate().map(term).collect())
            }
            Value::Product(factors) => {
                let least = |index| if index == 0 { Binding::Product } else { Binding::Prefix };
                let factors = factors.iter().enumerate().map(|(index, factor)| self.operand(*factor, least(index)));
                style.product(factors.collect())
            }
            Value::Quotient(above, below) => {
                style.quotient(self.operand(*above, Binding::Product), self.operand(*below, Binding::Prefix))
            }
            // The operand is bound or a number: ordering gives all others a statement.
            Value::Square(base) => {
                style.square(self.operand(*base, Binding::Product), self.operand(*base, Binding::Prefix))
            }
            Value::Negative(inside) => style.negative(self.operand(*inside, Binding::Product)),
            Value::Call(function, arguments) => {
                let mut arguments = arguments.iter().map(|argument| match argument.negative {
                    true => (Binding::Prefix, style.negative(self.operand(argument.value, Binding::Product))),
                    false => (self.binding(argument.value), self.value(argument.value)),
                });
                let first = arguments.next().map(|(binding, first)| style.argument(binding, first));
                style.elementary(*function, first, arguments.map(|(_, text)| text).collect())
            }
            Value::All(conditions) => style.all(self.values(conditions)),
            Value::Text(text) => style.text(text),
            Value::Count(count) => style.count(*count),
            Value::Path(constant) => style.constant(*constant),
            Value::Field(of, name) => style.field(self.operand(*of, Binding::Atom), self.names.text(*name)),
            Value::Member(of, place) => style.field(self.operand(*of, Binding::Atom), &place.to_string()),
            Value::Columns(of) => style.field(style.field(self.operand(*of, Binding::Atom), "data"), "0"),
            Value::Index(of, index) => style.index(self.operand(*of, Binding::Atom), *index),
            Value::At(of, index) => style.entry(self.operand(*of, Binding::Atom), self.value(*index)),
            Value::List(values) => style.list(self.values(values)),
            Value::Repeated(value, count) => style.repeated(self.value(*value), *count),
            Value::Tuple(values) => style.tuple(self.values(values)),
            Value::Struct(of, members, rest) => {
                let members = members.iter().map(|(field, value)| {
                    let field = self.names.text(*field);
                    let is_name = self.code.name_of(*value) == Some(field);
                    (field.to_owned(), (!is_name).then(|| self.value(*value)))
                });
                style.structure(of, members.collect(), rest.map(|rest| self.value(rest)))
            }
            Value::Intrinsic(of, of_type, arguments) => self.intrinsic(*of, of_type.as_deref(), arguments),
            Value::Function(of, of_type) => style.function(of_type.as_deref(), of.row().name),
            Value::Own(receiver, function, arguments) => {
                let callee = self.callee(receiver.callee(*function));
                let on = match receiver {
                    Receiver::Itself if callee.is_of_mechanism => On::Mechanism(style.name("self")),
                    Receiver::Itself => On::Value(style.name("self")),
                    Receiver::ItsType => On::Type(Type::Itself),
                    Receiver::Value(of) if callee.is_of_mechanism => {
                        On::Mechanism(style.borrowed(self.operand(*of, Binding::Prefix)))
                    }
                    Receiver::Value(of) => On::Value(self.operand(*of, Binding::Atom)),
                    Receiver::Type(of) => On::Type((**of).clone()),
                };
                style.call(on, &callee.name, self.values(arguments))
            }
            Value::UserFunction(function, arguments) => {
                let callee = self.callee(Callee::User(*function));
                style.call(On::Type(Type::Itself), &callee.name, self.values(arguments))
            }
            Value::Try(value) => style.tried(self.operand(*value, Binding::Atom)),
            Value::Borrowed(value) => style.borrowed(self.operand(*value, Binding::Prefix)),
            Value::MutablyBorrowed(value) => style.mutably_borrowed(self.operand(*value, Binding::Prefix)),
            Value::Dereferenced(value) => style.dereferenced(self.operand(*value, Binding::Prefix)),
            Value::Closure { arguments, body, moves } => {
                let Block { statements, value } = &**body;
                let arguments = arguments.iter().map(|argument| self.pattern(argument)).collect();
                style.closure(arguments, self.statements(statements), self.value(*value), *moves)
            }
            Value::Block(block) => {
                let Block { statements, value } = &**block;
                let is_unit = matches!(self.code.operation(*value), Value::Tuple(all) if all.is_empty());
                style.block(self.statements(statements), (!is_unit).then(|| self.value(*value)))
            }
        }
    }

    fn callee(&self, of: Callee) -> &Called {
        self.code.callee(of).expect("lowering finds all functions that code calls")
    }

    fn intrinsic(&self, of: Intrinsic, of_type: Option<&Type>, arguments: &[ValueId]) -> S::Text {
        let (on, arguments) = match (of.row().form, of_type, arguments) {
            (Form::Method, _, [receiver, arguments @ ..]) => {
                (On::Value(self.operand(*receiver, Binding::Atom)), arguments)
            }
            (_, Some(of_type), _) => (On::Type(of_type.clone()), arguments),
            _ => (On::Runtime, arguments),
        };
        self.style.call(on, of.row().name, self.values(arguments))
    }
}
