//! Groups of two and three loops of links: which are found, and that their formulas are the loop equations.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use linkage_compiler::derivation::Derivation;
use linkage_compiler::graph::{NodeId, SymbolId};
use linkage_compiler::structure::{GroupKind, Loops, Obstacle};
use linkage_compiler::{derive, read};
use proc_macro2::{TokenStream, TokenTree};

/// The derivation of a mechanism of the gallery.
fn gallery(file: &str) -> Derivation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../dev/gallery/src/mechanisms/{file}.rs"));
    let tokens: Vec<TokenTree> =
        fs::read_to_string(path).unwrap().parse::<TokenStream>().unwrap().into_iter().collect();
    let Some(TokenTree::Group(group)) = tokens.last() else { panic!("{file} has no `linkage!`") };
    // With several drivers, the last.
    derive(&read(group.stream()).unwrap()[0]).pop().unwrap()
}

/// The derivation of a mechanism with the parameters a to f that are used, the input v and these unknowns.
fn written(unknowns: &str, statements: &str) -> Derivation {
    let words: Vec<&str> = statements.split(|letter: char| !letter.is_alphanumeric()).collect();
    let parameters = ["a", "b", "c", "d", "e", "f"].into_iter().filter(|name| words.contains(name));
    let parameters = parameters.collect::<Vec<_>>().join(", ");
    let source = format!("mechanism M {{ param {parameters}; input v; unknown {unknowns}; {statements} }}");
    derive(&read(source.parse().unwrap()).unwrap_or_else(|errors| panic!("{source}: {errors:?}"))[0]).remove(0)
}

fn groups(derivation: &Derivation) -> Vec<GroupKind> {
    derivation.groups.iter().map(|group| group.kind).collect()
}

/// A generator of angles and lengths (xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 6.0 - 3.0
    }
}

fn checked(derivation: &mut Derivation) -> Vec<usize> {
    checked_with(derivation, [0.0; 2])
}

/// At any angles the magnitudes of the loops are those of the rows, so that both vanish together: the sum of the squares
/// of all rows. From the second loop as written, m times the first was subtracted, by which a length was eliminated.
/// Returns the number of coefficients that are not zero, by group.
fn checked_with(derivation: &mut Derivation, m: [f64; 2]) -> Vec<usize> {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut counts = Vec::new();
    for group in derivation.groups.clone().iter().filter(|group| matches!(group.kind, GroupKind::Loops(_))) {
        let rows = derivation.residual.at(&group.equations);
        let coordinate = |unknown| derivation.coordinates[derivation.unknowns[unknown]].value;
        let unknowns: Vec<SymbolId> = group.unknowns.iter().map(|&unknown| coordinate(unknown)).collect();
        let loops = Loops::of(&mut derivation.graph, &rows, &unknowns).unwrap();
        assert_eq!(group.kind, GroupKind::Loops(loops.constants.len()));
        assert_eq!((2 * loops.constants.len(), loops.directions.len()), (rows.len(), unknowns.len()));
        for _ in 0..20 {
            let symbols = derivation.graph.symbols_of(&[rows.clone(), loops.nodes()].concat());
            let values: BTreeMap<SymbolId, f64> = symbols.into_iter().map(|symbol| (symbol, numbers.next())).collect();
            let value = |node: NodeId| derivation.graph.evaluate(&[node], |symbol| values[&symbol])[0];
            let angles: Vec<f64> = unknowns.iter().map(|unknown| values[unknown]).collect();
            let combined = |factors: &[i64], of: &[f64]| -> f64 {
                factors.iter().zip(of).map(|(factor, angle)| *factor as f64 * angle).sum()
            };
            let directions: Vec<f64> = loops.directions.iter().map(|factors| combined(factors, &angles)).collect();
            for (factors, angle) in loops.unknowns.iter().zip(&angles) {
                assert!((combined(factors, &directions) - angle).abs() < 1e-13);
            }
            let closures =
                loops.constants.iter().zip(&loops.factors).enumerate().map(|(place, (constant, factors))| {
                    let mut sum = constant.map(value);
                    let mut add = |[real, imaginary]: [f64; 2], times: f64, angle: f64| {
                        sum[0] += times * (real * angle.cos() - imaginary * angle.sin());
                        sum[1] += times * (real * angle.sin() + imaginary * angle.cos());
                    };
                    for (part, angle) in factors.iter().zip(&directions) {
                        add(part.map(value), 1.0, *angle);
                    }
                    for (guide, length) in loops.guides.iter().zip(&angles) {
                        if let Some(guide) = guide.filter(|guide| guide.in_loop == place) {
                            add(guide.along.map(value), *length, guide.with.map_or(0.0, |with| directions[with]));
                        }
                    }
                    sum
                });
            let mut closures: Vec<[f64; 2]> = closures.collect();
            let [x, y] = closures[0];
            closures[1][0] += m[0] * x - m[1] * y;
            closures[1][1] += m[0] * y + m[1] * x;
            let of_loops: f64 = closures.iter().flatten().map(|part| part.powi(2)).sum();
            let of_rows: f64 = rows.iter().map(|&row| value(row).powi(2)).sum();
            assert!((of_loops - of_rows).abs() < 1e-12 * of_rows, "{of_loops} {of_rows}");
        }
        let is_there = |factor: &&[NodeId; 2]| factor.iter().any(|&part| !derivation.graph.is_zero(part));
        counts.push(loops.constants.iter().chain(loops.factors.iter().flatten()).filter(is_there).count());
    }
    counts
}

#[test]
fn of_the_gallery() {
    let mut double_butterfly = gallery("double_butterfly");
    assert_eq!(groups(&double_butterfly), [GroupKind::Loops(3)]);
    // Three constants, and 3 + 4 + 3 links.
    assert_eq!(checked(&mut double_butterfly), [3 + 3 + 4 + 3]);
    let mut stephenson = gallery("stephenson_far");
    assert_eq!(groups(&stephenson), [GroupKind::Loops(2), GroupKind::Rrr]);
    assert_eq!(checked(&mut stephenson), [2 + 3 + 3]);
    let mut robot = gallery("three_rrr");
    assert_eq!(groups(&robot), [GroupKind::Loops(2), GroupKind::Linear, GroupKind::Linear]);
    assert_eq!(checked(&mut robot), [2 + 3 + 3]);
    let mut triads = gallery("two_triads");
    assert_eq!(groups(&triads), [GroupKind::Rrr, GroupKind::Loops(2), GroupKind::Loops(2)]);
    assert_eq!(checked(&mut triads).len(), 2);
}

#[test]
fn directions_of_links() {
    for (unknowns, statements, expected) in [
        (
            "p, q, r, s",
            "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@q = (1, 2) + c@s;",
            &[GroupKind::Loops(2)][..],
        ),
        // Clockwise angles, and angles from a known direction.
        (
            "p, q, r, s",
            "loop a@v + b@(v - p) + c@(-q) = d@0 + e@(90deg - r); loop b@(v - p) + f@(30deg - q) = (1, 2) + c@(-s);",
            &[GroupKind::Loops(2)],
        ),
        // Angles from the link before.
        (
            "p, q, r, s",
            "loop a@v + b@(v + p) + c@(v + p + q) = e@r; loop b@(v + p) + f@(v + p + q) = (1, 2) + c@(r + s);",
            &[GroupKind::Loops(2)],
        ),
        // A joint by its coordinates, and a number of one loop before the other.
        (
            "x, y, p, q, r, s",
            "loop a@v + b@p = (x, y); loop (x, y) + c@q = d@0 + e@r; loop (x, y) + f@q = (1, 2) + c@s;",
            &[GroupKind::Loops(2), GroupKind::Linear, GroupKind::Linear],
        ),
        // x and y come from different loops.
        (
            "x, y, p, q, r, s",
            "loop (x, y) + b@p = a@v; loop c@q + e@r = (d, 0) + (x, y) - f@p; loop b@p + f@q = (1, y) + c@s + (x, 0) - (0, 2);",
            &[GroupKind::Loops(2), GroupKind::Linear, GroupKind::Linear],
        ),
        // Two angles that are known from a group before, and gears.
        (
            "p, q, r, s, t",
            "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@q = (1, 2) + c@s; equation t = 2*s - v;",
            &[GroupKind::Loops(2), GroupKind::Linear],
        ),
    ] {
        let mut derivation = written(unknowns, statements);
        assert_eq!(groups(&derivation), expected, "{statements}");
        assert_eq!(checked(&mut derivation).len(), 1);
    }
}

/// The counts are those of the coefficients that are not zero, without the guides.
#[test]
fn sliders() {
    for (unknowns, statements, guides, m, count) in [
        // Along a given direction, and along an axis.
        (
            "p, q, r, s",
            "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@q = (1, 2) + s@v;",
            &[(1, None)][..],
            [0.0; 2],
            7,
        ),
        (
            "p, q, r, s",
            "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@q = (1, 2) - s@90deg;",
            &[(1, None)],
            [0.0; 2],
            7,
        ),
        // Along a link, with an offset, and written as parts; a clockwise angle.
        (
            "p, q, r, s",
            "loop a@v + b@p + (s + f, c)@q = d@0 + e@r; loop a@v + b@p + f@q = (1, 2) + e@r;",
            &[(0, Some(1))],
            [0.0; 2],
            8,
        ),
        (
            "p, q, r, s",
            "loop a@v + b@p + s@(-q) = d@0 + e@r; loop a@v + b@p + f@(-q) = (1, 2) + e@r;",
            &[(0, Some(1))],
            [0.0; 2],
            7,
        ),
        // Two sliders, one of them with a joint by its coordinates.
        (
            "p, q, s, t",
            "loop a@v + b@p + c@q = (d, 0) + s@q; loop a@v + b@p + f@q = (1, 2) + t@v;",
            &[(0, Some(1)), (1, None)],
            [0.0; 2],
            6,
        ),
        (
            "x, y, p, q, r, s",
            "loop a@v + b@p = (x, y); loop (x, y) + c@q = d@0 + e@r; loop (x, y) + f@q = (1, 2) + s@0;",
            &[(1, None)],
            [0.0; 2],
            7,
        ),
        // A length in two loops, along the same line, against it, and along another.
        ("p, q, r, s", "loop a@v + b@p + c@q = s@v; loop s@v + f@q = (1, 2) + e@r;", &[(0, None)], [-1.0, 0.0], 7),
        (
            "p, q, r, s",
            "loop a@v + b@p + c@q = s@r; loop d@0 + f@q + b@p = (1, 2) + (2*s)@(r + 90deg);",
            &[(0, Some(2))],
            [0.0, 2.0],
            6,
        ),
    ] {
        let mut derivation = written(unknowns, statements);
        assert_eq!(groups(&derivation)[0], GroupKind::Loops(2), "{statements}");
        assert_eq!(guides_of(&mut derivation), guides, "{statements}");
        assert_eq!(checked_with(&mut derivation, m), [count], "{statements}");
    }
    let mut fixed = gallery("slider_triad");
    assert_eq!(groups(&fixed), [GroupKind::Loops(2)]);
    assert_eq!(checked(&mut fixed), [2 + 2 + 3]);
    let mut turning = gallery("swivel_triad");
    assert_eq!(groups(&turning), [GroupKind::Loops(2)]);
    assert_eq!(checked(&mut turning), [2 + 2 + 3]);
}

/// The loop and the direction of each length, in the first group.
fn guides_of(derivation: &mut Derivation) -> Vec<(usize, Option<usize>)> {
    let group = derivation.groups.iter().find(|group| matches!(group.kind, GroupKind::Loops(_))).unwrap().clone();
    let rows = derivation.residual.at(&group.equations);
    let unknowns = group.unknowns.iter().map(|&place| derivation.coordinates[derivation.unknowns[place]].value);
    let unknowns: Vec<SymbolId> = unknowns.collect();
    let loops = Loops::of(&mut derivation.graph, &rows, &unknowns).unwrap();
    loops.guides.iter().flatten().map(|guide| (guide.in_loop, guide.with)).collect()
}

#[test]
fn other_groups_need_a_guess() {
    let angles = Obstacle::NotLoops;
    for (unknowns, statements, count, obstacle) in [
        // Lengths along two lines that turn; two in one loop; a product of two, and a square; and in a function.
        ("p, q, s, t", "loop a@v + b@p + c@q = s@p; loop b@p + f@q = (1, 2) + t@q;", 4, Obstacle::TwoGuides),
        ("p, q, r, s", "loop a@v + b@p + s@q = e@r; loop b@p + f@q = (1, 2) + s@r;", 4, Obstacle::TwoGuides),
        (
            "p, q, s, t",
            "loop a@v + b@p + c@q = s@v + t@p; loop b@p + f@q = (1, 2) + (s + t)@v;",
            4,
            Obstacle::LengthsInOneLoop,
        ),
        ("p, q, s, t", "loop a@v + b@p + c@q = s@v; loop b@p + f@q = (1, 2) + (s*t)@v;", 4, Obstacle::ProductOfLengths),
        ("p, q, r, s", "loop a@v + b@p + c@q = s@v; loop b@p + f@q = (1, 2) + (s*s)@r;", 4, Obstacle::ProductOfLengths),
        ("p, q, r, s", "loop a@v + b@p + c@q = s@v; loop b@p + f@q = (1, 2) + sqrt(s)@r;", 4, angles),
        // A direction and its mirror image.
        ("p, q, r, s", "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@(-q) = (1, 2) + c@s;", 4, angles),
        // An angle and twice the angle: five directions.
        ("p, q, r, s", "loop a@v + b@p + c@q = d@0 + e@r; loop a@v + b@p + f@(2*q) = (1, 2) + c@s;", 4, angles),
        // The sum and the difference give twice the angles.
        ("p, q, r, s", "loop a@v + b@(p+q) + c@(p-q) = e@r; loop a@v + b@(p+q) + f@(p-q) = (1, 2) + c@s;", 4, angles),
        // Equations that are no loops.
        (
            "p, q, r, s",
            "loop a@v + b@p + c@q = e@r; equation b*cos(p) + c*sin(s) = a; equation d*cos(q) + f*cos(s) = v;",
            4,
            angles,
        ),
        (
            "p, q, r, s, t, u, w, z",
            "loop a@v + b@p + c@q = d@r; loop a@v + b@p + c@s = d@t + (1, 1); loop (2, 3) + e@q + f@s = a@u + b@w; \
             loop (1, 2) + a@r + c@u = d@t + e@z; ",
            8,
            Obstacle::MoreLoops,
        ),
    ] {
        let derivation = written(unknowns, statements);
        assert_eq!(groups(&derivation), [GroupKind::Irreducible(count, obstacle)], "{statements}");
        let found = derivation.groups.iter().find_map(|group| group.kind.obstacle()).unwrap();
        assert_eq!(found, format!("its {count} unknowns depend on one another, and {}", obstacle.text()));
    }
}
