//! The largest texts of each shape, and smaller ones, on a small stack: they end with mechanisms or messages.
//!
//! `STRANGERS_STACK` is another number of KiB of stack, `STRANGERS_STEPS` another budget, `STRANGERS` chooses shapes by a part of
//! their names between two `=`.

use std::time::{Duration, Instant};
use std::{env, thread};

use linkage_compiler::budget::Budget;
use linkage_compiler::text;
use linkage_trials::count;
use proc_macro2::{TokenStream, TokenTree};

/// The stack of a thread of Rust, in KiB.
const STACK: usize = 2048;

/// A shape of texts: its name, and the text of a size.
type Shape = (&'static str, fn(usize) -> String);

/// A mechanism with an output of this value.
fn with_output(value: &str) -> String {
    with(&format!("output o = {value} + v;"))
}

/// A mechanism with these statements.
fn with(statements: &str) -> String {
    format!("mechanism M {{ param a = 2; input v; unknown u; equation u = a * v; {statements} }}")
}

fn repeated(part: &str, count: usize) -> String {
    part.repeat(count)
}

/// The parts for each number from 0.
fn each(count: usize, part: impl Fn(usize) -> String) -> String {
    (0..count).map(part).collect()
}

/// A link that each point adds to the one before, with the forces in its joints.
fn chain_of(kind: &str, count: usize, is_reacting: bool) -> String {
    let links = each(count, |index| match index {
        0 => format!("{kind} P0 = a@v;"),
        _ => format!("{kind} P{index} = P{} + a@({index}*v);", index - 1),
    });
    let body = format!("body b {{ mass 1; inertia 1; center P{}; angle v; }}", count.saturating_sub(1));
    let reaction = if is_reacting { "reactions;" } else { "" };
    format!("mechanism M {{ param a = 2; input v; {links} {body} scene S {{ inertia; {reaction} }} }}")
}

const SHAPES: &[Shape] = &[
    ("parentheses", |n| with_output(&format!("{}v{}", repeated("(", n), repeated(")", n)))),
    ("calls", |n| with_output(&format!("{}v{}", repeated("sin(", n), repeated(")", n)))),
    ("brackets", |n| with_output(&format!("{}v{}", repeated("[", n), repeated("]", n)))),
    ("braces", |n| format!("{}{}", repeated("{", n), repeated("}", n))),
    ("open brackets", |n| repeated("(", n)),
    ("closed brackets", |n| repeated("]", n)),
    ("lists in parentheses", |n| with(&format!("input {}w{};", repeated("(", n), repeated(")", n)))),
    ("minus", |n| with_output(&format!("{}v", repeated("-", n)))),
    ("minus apart", |n| with_output(&format!("{}v", repeated("- ", n)))),
    ("plus", |n| with_output(&format!("{}v", repeated("+", n)))),
    ("plus minus", |n| with_output(&format!("{}v", repeated("+ -", n)))),
    ("minus plus", |n| with_output(&format!("{}v", repeated("- +", n)))),
    ("references", |n| with_output(&format!("{}v", repeated("&", n)))),
    ("dots", |n| with_output(&format!("{}v", repeated("... ", n)))),
    ("bars", |n| with_output(&format!("{}v{}", repeated("|", n), repeated("|", n)))),
    ("bars apart", |n| with_output(&format!("{}v", repeated("| ", n)))),
    ("bars minus", |n| with_output(&format!("{}v{}", repeated("|-", n), repeated("|", n)))),
    ("bars of products", |n| with_output(&format!("{}v", repeated("|v|*", n)))),
    ("powers", |n| with_output(&format!("v{}", repeated("^v", n)))),
    ("stars", |n| with_output(&format!("v{}", repeated("**v", n)))),
    ("negative powers", |n| with_output(&format!("v{}", repeated("^-", n)))),
    ("powers of two", |n| with_output(&format!("v{}", repeated("^2", n)))),
    ("vectors", |n| with(&format!("point P = a{};", repeated("@v", n)))),
    ("sum", |n| with_output(&format!("v{}", repeated(" + v", n)))),
    ("differences", |n| with_output(&format!("v{}", repeated(" - u", n)))),
    ("sum of numbers", |n| with_output(&format!("v{}", each(n, |i| format!(" + {i}.5*v"))))),
    ("sum of vectors", |n| with(&format!("point P = a@v{};", repeated(" + a@u", n)))),
    ("sum of others", |n| with_output(&format!("v{}", each(n, |i| format!(" + sin({i}*v)"))))),
    ("product", |n| with_output(&format!("v{}", repeated(" * v", n)))),
    ("product of others", |n| with_output(&format!("v{}", each(n, |i| format!(" * (v + {i})"))))),
    ("quotients", |n| with_output(&format!("v{}", repeated(" / a", n)))),
    ("adjacent", |n| with_output(&format!("v{}", repeated(" v", n)))),
    ("adjacent functions", |n| with_output(&format!("v{}", repeated(" sin", n)))),
    ("numbers", |n| with_output(&format!("v{}", repeated(" 2", n)))),
    ("units", |n| with_output(&format!("2{}", repeated(" deg", n)))),
    ("methods", |n| with_output(&format!("v{}", repeated(".sin()", n)))),
    ("methods in a loop", |n| {
        format!("mechanism M {{ input v; unknown u; equation u = v{}; }}", repeated(".sin()", n))
    }),
    ("methods of a default", |n| format!("mechanism M {{ param a = 2{}; }}", repeated(".sin()", n))),
    ("fields", |n| with_output(&format!("v{}", repeated(".x", n)))),
    ("indices", |n| with_output(&format!("v{}", repeated("[0]", n)))),
    ("conditions", |n| with_output(&repeated("if v { 1 } else ", n))),
    ("paths", |n| with_output(&format!("a{}", repeated("::a", n)))),
    ("implied", |n| with(&format!("{}loop a@v = a@u;", repeated("implied ", n)))),
    ("commas", |n| with(&format!("input w{};", repeated(",", n)))),
    ("decimal commas", |n| with(&format!("input w{};", repeated(", 5", n)))),
    ("semicolons", |n| with(&repeated(";", n))),
    ("negations in an attribute", |n| format!("#[doc = {}x] {}", repeated("!", n), with(""))),
    ("minus in an attribute", |n| format!("#[doc = {}1] {}", repeated("- ", n), with(""))),
    ("references in an attribute", |n| format!("#[doc = {}x] {}", repeated("&", n), with(""))),
    ("sum in an attribute", |n| format!("#[doc = 1{}] {}", repeated(" + 1", n), with(""))),
    ("casts in an attribute", |n| format!("#[doc = 1{}] {}", repeated(" as u8", n), with(""))),
    ("fields in an attribute", |n| format!("#[doc = x{}] {}", repeated(".a", n), with(""))),
    ("calls in an attribute", |n| format!("#[doc = x{}] {}", repeated("()", n), with(""))),
    ("comparisons in an attribute", |n| format!("#[doc = 1{}] {}", repeated(" = 1", n), with(""))),
    ("generics in an attribute", |n| format!("#[doc = x::{}y] {}", repeated("a<", n), with(""))),
    ("paths in an attribute", |n| format!("#[doc = {}y] {}", repeated("<a as ", n), with(""))),
    ("generics in derive", |n| format!("#[derive({}A)] {}", repeated("A<", n), with(""))),
    ("references in derive", |n| format!("#[derive(A<{}A>)] {}", repeated("&", n), with(""))),
    ("pointers in derive", |n| format!("#[derive(A<{}A>)] {}", repeated("*const ", n), with(""))),
    ("functions in derive", |n| format!("#[derive(A<{}A>)] {}", repeated("fn() -> ", n), with(""))),
    ("negations in derive", |n| format!("#[derive(A<{{{}a}}>)] {}", repeated("!", n), with(""))),
    ("paths in derive", |n| format!("#[derive({}A)] {}", repeated("A::", n), with(""))),
    ("traits", |n| format!("#[derive({})] {}", each(n, |i| format!("T{i},")), with(""))),
    ("attributes", |n| format!("{}{}", repeated("#[a]", n), with(""))),
    ("attributes of parts", |n| with(&repeated("#[a] let b = v;", n))),
    ("hashes", |n| with(&repeated("#", n))),
    ("doc comments", |n| with(&repeated("/// a\n", n))),
    ("comments", |n| repeated("/*", n)),
    ("visibilities", |n| format!("pub(in a{}) {}", repeated("::a", n), with(""))),
    ("generic functions", |n| with(&format!("extern fn {}(x) -> (f, df, ddf);", repeated("a<", n)))),
    ("paths of functions", |n| with(&format!("extern fn a{}(x) -> (f, df, ddf);", repeated("::a", n)))),
    ("functions", |n| with(&each(n, |i| format!("extern fn f{i}(x) -> (f{i}, df{i}, ddf{i});")))),
    ("derivatives of a function", |n| with(&format!("extern fn f(x) -> (f{});", each(n, |i| format!(", d{i}"))))),
    ("arguments", |n| with_output(&format!("hypot(v{})", repeated(", v", n)))),
    ("names of scalars", |n| {
        with(&format!("let n0 = v;{} output o = n{n};", each(n, |i| format!("let n{} = sin(n{i});", i + 1))))
    }),
    ("squares of names", |n| {
        with(&format!("let n0 = v;{} output o = n{n};", each(n, |i| format!("let n{0} = n{i} * n{i} + n{i};", i + 1))))
    }),
    ("quotients of names", |n| {
        with(&format!("let n0 = v;{} output o = n{n};", each(n, |i| format!("let n{} = 1/(1 + n{i});", i + 1))))
    }),
    ("roots of names", |n| {
        with(&format!("let n0 = v;{} output o = n{n};", each(n, |i| format!("let n{} = sqrt(1 + n{i}) + {i};", i + 1))))
    }),
    ("other names", |n| {
        with(&format!("let n0 = v;{} output o = n{n};", each(n, |i| format!("let n{} = n{i};", i + 1))))
    }),
    ("other vectors", |n| {
        with(&format!("let n0 = a@v;{} point P = n{n};", each(n, |i| format!("let n{} = n{i};", i + 1))))
    }),
    ("names in a loop", |n| {
        let names = each(n, |i| format!("let n{} = sin(n{i}) + n{i};", i + 1));
        format!("mechanism M {{ input v; unknown u; let n0 = v; {names} equation u = n{n}; }}")
    }),
    ("names of an unknown", |n| {
        let names = each(n, |i| format!("let n{} = sin(n{i}) + {i}.5;", i + 1));
        format!("mechanism M {{ input v; unknown u; let n0 = u; {names} equation v = n{n}; }}")
    }),
    ("points", |n| chain_of("point", n, false)),
    ("vectors by name", |n| chain_of("let", n, false)),
    ("reactions of points", |n| chain_of("point", n, true)),
    ("reactions of vectors by name", |n| chain_of("let", n, true)),
    ("reactions of other names", |n| {
        let names = each(n, |i| format!("let n{} = n{i};", i + 1));
        format!(
            "mechanism M {{ param a = 2; input v; let n0 = a@v; {names} body b {{ mass 1; inertia 1; center n{n}; angle v; }} \
             scene S {{ inertia; reactions; }} }}"
        )
    }),
    ("a loop of many links", |n| {
        format!("mechanism M {{ param a = 2; input v; unknown u, w; loop a@v + a@u{} = a@w; }}", repeated(" + a@v", n))
    }),
    ("links of a chain", |n| {
        let unknowns = each(2 * n, |i| format!("unknown u{i};"));
        let loops = each(n, |i| {
            let before = if i == 0 { "v".to_owned() } else { format!("u{}", 2 * i - 1) };
            format!("loop a@{before} + a@u{} + a@u{} = a@0;", 2 * i, 2 * i + 1)
        });
        format!("mechanism M {{ param a = 2; input v; {unknowns} {loops} }}")
    }),
    ("unknowns solved together", |n| {
        let sum = each(n, |i| format!(" + u{i}"));
        let rows = each(n, |i| format!("equation sin(u{i}) * v{sum} = {i};"));
        format!("mechanism M {{ input v; {} {rows} }}", each(n, |i| format!("unknown u{i};")))
    }),
    ("parameters", |n| with(&each(n, |i| format!("param p{i} = 1;")))),
    ("parameters of one name", |n| with(&repeated("param p = 1;", n))),
    ("points of one name", |n| with(&repeated("point P = a@v;", n))),
    ("inputs", |n| with(&each(n, |i| format!("input i{i};")))),
    ("unknowns", |n| with(&each(n, |i| format!("unknown i{i};")))),
    ("unknown names", |n| with_output(&format!("v{}", each(n, |i| format!(" + name{i}x"))))),
    ("unknown names like others", |n| {
        let names = each(n, |i| format!("let name{i}x = v;"));
        with(&format!("{names} output o = v{};", each(n, |i| format!(" + nane{i}x"))))
    }),
    ("unknown functions", |n| with_output(&format!("v{}", each(n, |i| format!(" + f{i}n(v)"))))),
    ("unknown statements", |n| with(&each(n, |i| format!("word{i} = v;")))),
    ("unknown words", |n| with(&each(n, |i| format!("word{i} ")))),
    ("unknown coordinates", |n| with(&repeated("unknwon w;", n))),
    ("unknown requests", |n| with(&format!("derive limits{};", each(n, |i| format!(", limit{i}s"))))),
    ("requests", |n| with(&repeated("derive limits, jerk;", n))),
    ("missing semicolons", |n| with(&each(n, |i| format!("let l{i} = v ")))),
    ("missing values", |n| with(&repeated("let l = ;", n))),
    ("errors in statements", |n| with(&repeated("output o = ) ;", n).replace(')', "$"))),
    ("equal errors", |n| with(&repeated("output o = w;", n))),
    ("drivers", |n| {
        let drivers = each(n, |i| format!("drive D{i} by v;"));
        format!("mechanism M {{ param a = 2; coordinate v, u; equation u = a * v; {drivers} }}")
    }),
    ("bodies", |n| {
        let bodies = each(n, |i| format!("body b{i} {{ mass 1; center a@v; }}"));
        with(&format!("{bodies} scene S {{ inertia; }}"))
    }),
    ("scenes", |n| {
        with(&format!("body b {{ mass 1; center a@v; }}{}", each(n, |i| format!("scene S{i} {{ inertia; }}"))))
    }),
    ("effects", |n| {
        let effects = each(n, |i| format!("spring 1, {i} on v;"));
        with(&format!("body b {{ mass 1; center a@v; }} scene S {{ inertia; {effects} }}"))
    }),
    ("unknown effects", |n| with(&format!("scene S {{ {} }}", each(n, |i| format!("sprong{i} 1;"))))),
    ("frictions", |n| {
        let effects = each(n, |i| format!("friction 0.{i} on v;"));
        with(&format!("body b {{ mass 1; center a@v; }} scene S {{ inertia; {effects} }}"))
    }),
    ("stops", |n| {
        let effects = each(n, |i| format!("stop v in 0..{};", i + 1));
        with(&format!("body b {{ mass 1; center a@v; }} scene S {{ inertia; {effects} }}"))
    }),
    ("potentials", |n| {
        let effects = each(n, |i| format!("potential sin({i} * v);"));
        with(&format!("body b {{ mass 1; center a@v; }} scene S {{ inertia; {effects} energy; power; equilibrium; }}"))
    }),
    ("ranges", |n| with(&each(n, |i| format!("output o{i} in 0..{i} = v;")))),
    ("outputs", |n| with(&each(n, |i| format!("output o{i} = sin({i} * v);")))),
    ("mechanisms", |n| each(n, |i| format!("mechanism M{i} {{}}"))),
    ("mechanisms of one name", |n| repeated("mechanism M {}", n)),
    ("whole mechanisms", |n| each(n, |i| with("").replace("mechanism M", &format!("mechanism M{i}")))),
    ("words instead of mechanisms", |n| repeated("mechanisn ", n)),
    ("a long name", |n| with(&format!("let {} = v;", repeated("n", n)))),
    ("two long names", |n| with(&format!("let m{0} = v; output o = k{0};", repeated("nm", n / 2)))),
    ("many names of some length", |n| {
        let length = n.isqrt();
        let names = each(length, |i| format!("let m{}{i}x = v;", repeated("n", length / 2)));
        with(&format!("{names} output o = v{};", each(length, |i| format!(" + k{}{i}y", repeated("n", length / 2)))))
    }),
    ("a long number", |n| with_output(&repeated("9", n))),
    ("a long fraction", |n| with_output(&format!("0.{}", repeated("9", n)))),
    ("a long hexadecimal number", |n| with_output(&format!("0x{}", repeated("f", n)))),
    ("a long binary number", |n| with_output(&format!("0b{}", repeated("1", n)))),
    ("a long exponent", |n| with_output(&format!("1e{}", repeated("9", n)))),
    ("underscores in a number", |n| with_output(&format!("1{}", repeated("_", n)))),
    ("a long suffix", |n| with_output(&format!("1{}", repeated("x", n)))),
    ("a long text", |n| with_output(&format!("\"{}\"", repeated("x", n)))),
    ("a long character", |n| with_output(&repeated("'x'", n))),
    ("a long doc comment", |n| format!("/** {} */ {}", repeated("x\n", n), with(""))),
    ("quotes", |n| with_output(&repeated("\"", n))),
    ("letters outside ASCII", |n| with_output(&repeated("\u{3b8}", n))),
    ("blanks", |n| repeated(" \n", n)),
    ("dollars", |n| with(&repeated("$", n))),
    ("colons", |n| with(&format!("param p{};", repeated(": u", n)))),
    ("equalities", |n| with(&format!("equation v{};", repeated(" = v", n)))),
    ("ends of ranges", |n| with(&format!("unknown w in 0{};", repeated("..1", n)))),
];

/// The sizes of each shape: the largest that fits, and fractions of it.
const FRACTIONS: [usize; 4] = [1000, 30, 4, 1];

/// In the inner ring one of so many shapes has these sizes.
const FEW: usize = 3;

/// A size that every shape has.
const SMALL: usize = 20;

/// The number of tokens of a text; 0 if it is none.
fn tokens(text: &str) -> usize {
    let Ok(tokens) = text.parse::<TokenStream>() else { return 0 };
    let (mut levels, mut count) = (vec![tokens], 0);
    while let Some(level) = levels.pop() {
        for token in level {
            count += 1;
            if let TokenTree::Group(group) = token {
                levels.push(group.stream());
            }
        }
    }
    count
}

/// The largest number of repetitions with which a shape has no more tokens and bytes than a text may have.
fn largest(shape: fn(usize) -> String) -> usize {
    // Numbers in names have as many digits as in the largest texts.
    const SOME: usize = 2000;
    let (some, more) = (shape(SOME), shape(2 * SOME));
    let bytes = (more.len() - some.len()).max(1);
    let tokens = (tokens(&more) - tokens(&some)).max(1);
    let of = |most: usize, of_some: usize| (most as f64 * 0.98 * SOME as f64 / of_some as f64) as usize;
    of(text::LONGEST, bytes).min(of(text::MOST_TOKENS, tokens)).max(SOME)
}

/// The time and the steps that a text takes on a thread with little stack, and its mechanisms or messages.
fn time_of(
    name: &str,
    text: String,
    stack: usize,
    steps: usize,
) -> (Duration, usize, Result<usize, Vec<text::Message>>) {
    let work = move || {
        let start = Instant::now();
        let budget = Budget::new(steps);
        let found = text::compile(&text, &budget, |_| ()).map(|compiled| compiled.len());
        (start.elapsed(), steps - budget.left(), found)
    };
    let thread = thread::Builder::new().name(name.to_owned()).stack_size(stack << 10);
    thread.spawn(work).unwrap().join().unwrap_or_else(|_| panic!("{name} panics"))
}

#[test]
fn texts_of_every_shape_end_on_a_small_stack() {
    let (stack, steps) = (count("STRANGERS_STACK", STACK, STACK), count("STRANGERS_STEPS", 100_000, 100_000));
    let chosen = env::var("STRANGERS").unwrap_or_default();
    let shapes = SHAPES.iter().filter(|(name, _)| format!("={name}=").contains(&chosen));
    let small = shapes.clone().map(|(name, shape)| (name, shape, SMALL));
    let large = linkage_trials::some(shapes, FEW).flat_map(|(name, shape)| {
        let most = largest(*shape);
        FRACTIONS.map(|fraction| (name, shape, most / fraction))
    });
    for (name, shape, count) in small.chain(large) {
        let text = shape(count);
        if text.len() > text::LONGEST {
            continue;
        }
        let bytes = text.len();
        let (time, spent, found) = time_of(&format!("{name} {count}"), text, stack, steps);
        let said = match &found {
            Ok(count) => format!("{count} mechanisms"),
            Err(messages) => {
                let first: String = messages[0].to_string().chars().take(90).collect();
                format!("{} messages: {first}", messages.len())
            }
        };
        println!("{:8.3} s {bytes:8} bytes {spent:9} steps, {name} {count}: {said}", time.as_secs_f64());
    }
}
