//! Charts of tables: each place in the picture against the number, breaks, marks, and what cannot be drawn.

use linkage::chart::{Chart, Look, Polar, STYLE, Unit};
use linkage::table::{TableError, Units};
use linkage::{Elbow, Table};
use linkage_gallery::four_bar::*;
use linkage_oracle::close;

fn table() -> Table {
    Table::turn(&FourBar::default(), FourBarBranch::new(Elbow::Left), 360, 10.0).unwrap()
}

/// The picture is well-formed.
fn parse(svg: &str) {
    roxmltree::Document::parse(svg).unwrap();
}

/// The parts of the path of each curve, as places in pixels.
fn places(svg: &str) -> Vec<Vec<Vec<[f64; 2]>>> {
    let paths = svg.split("<path class=\"curve\" d=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0);
    // A sign of the legend is a horizontal stroke.
    let curves = paths.filter(|path| !path.contains('h'));
    curves.map(|path| path.split('M').skip(1).map(|part| part.split('L').map(place).collect()).collect()).collect()
}

fn place(text: &str) -> [f64; 2] {
    let (x, y) = text.split_once(' ').unwrap();
    [x, y].map(|number| number.parse().unwrap())
}

/// The ends of numbers.
fn ends(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], number| [low.min(number), high.max(number)])
}

/// In a chart of two columns the highest and the lowest places are those of the numbers, by one scale.
#[test]
fn places_are_those_of_the_numbers() {
    let table = table();
    let chart = Chart::of(&table, "theta2", ["theta3", "theta4"]).unwrap();
    assert_eq!((&chart.x.unit, &chart.y.unit, chart.has_legend), (&Unit::Degrees, &Unit::Degrees, true));
    assert_eq!(chart.title, "theta3, theta4 over theta2");
    let svg = chart.to_svg();
    parse(&svg);
    assert!(svg.contains(">360°</text>"));
    let curves = places(&svg);
    let [[of_theta3], [of_theta4]] = [curves[0].as_slice(), curves[1].as_slice()] else { panic!("{curves:?}") };
    let drawn = [of_theta3, of_theta4].map(|curve| ends(curve.iter().map(|[_, y]| -*y)));
    let numbers = ["theta3", "theta4"].map(|name| ends(table.column(name).unwrap().iter().copied()));
    let scale = (drawn[1][1] - drawn[0][0]) / (numbers[1][1] - numbers[0][0]);
    for (drawn, numbers) in drawn.iter().zip(&numbers) {
        for (drawn_at, number) in drawn.iter().zip(numbers) {
            // A place has one decimal.
            close("place", drawn_at - drawn[0], (number - numbers[0]) * scale, 0.2);
        }
    }
    // From one end of the axis to the other: 0 and 360 degrees.
    assert_eq!([of_theta3[0][0], of_theta3.last().unwrap()[0]], [48.0, 384.0]);
}

/// The axis has the unit of its columns, if they have one in common; degrees are drawn as radians are.
#[test]
fn units_of_axes() {
    let (radians, degrees) = (table(), table().degrees().units(Units::SI));
    let [one, other] = [&radians, &degrees].map(|table| Chart::of(table, "theta2", ["theta3"]).unwrap());
    assert_eq!(places(&one.to_svg()), places(&other.to_svg()));
    let speeds = Chart::of(&degrees, "time", ["theta3_rate", "theta4_rate"]).unwrap();
    assert_eq!([speeds.x.name.as_str(), speeds.y.name.as_str()], ["time [s]", "[deg/s]"]);
    let mixed = Chart::of(&degrees, "time", ["theta3_rate", "theta3"]).unwrap();
    assert_eq!((mixed.y.name.as_str(), &mixed.y.unit), ("", &Unit::Number));
    let many = Chart::of(&degrees, "time", ["theta3", "theta4", "theta3_rate", "theta4_rate"]).unwrap();
    assert_eq!(many.title, "theta3, … over time");
}

/// A row without a position breaks the curve; the ends of the motion are marked, and only over its input.
#[test]
fn curves_break_where_a_motion_has_no_position() {
    let m = FourBar { l2: 45.0, ..FourBar::default() };
    let inputs: Vec<f64> = (-180..=180).map(|degrees| f64::from(degrees).to_radians()).collect();
    let table = Table::at(&m, FourBarBranch::new(Elbow::Left), &inputs, 10.0).unwrap();
    let missing = table.missing().len();
    assert!(missing > 10 && missing < 350, "{missing}");
    let chart = Chart::of(&table, "theta2", ["theta3"]).unwrap();
    let points = &chart.curves[0].points;
    assert_eq!((points.len(), points.iter().flatten().count()), (361, 361 - missing));
    assert!(table.missing().iter().all(|missing| points[missing.row].is_none()));
    assert!(!chart.lines.is_empty() && chart.lines.iter().all(|line| line.name == "dead point"));
    let svg = chart.to_svg();
    assert!(svg.contains("<path class=\"line\"") && svg.contains(">dead point</text>"));
    // In degrees they are at the same places.
    let in_degrees = Chart::of(&table.clone().degrees(), "theta2", ["theta3"]).unwrap();
    for (one, other) in chart.lines.iter().zip(&in_degrees.lines) {
        close("mark", one.at, other.at, 1e-15 * one.at.abs());
    }
    assert!(Chart::of(&table, "theta4", ["theta3"]).unwrap().lines.is_empty());
}

/// Names at lines stay within the chart and do not overlap.
#[test]
fn names_of_many_events() {
    let mut chart = Chart::of(&table(), "time", ["theta3"]).unwrap();
    for event in 0..40 {
        let name = format!("event {event} & more");
        chart.lines.push(linkage::chart::Line { at: 0.2 + 0.01 * f64::from(event), name });
    }
    let svg = chart.to_svg();
    parse(&svg);
    let names = svg.split("<text class=\"soft mark\" ").skip(1).map(|rest| {
        let (head, text) = rest.split_once("</text>").unwrap().0.split_once('>').unwrap();
        let number = |of: &str| {
            let (_, rest) = head.split_once(&format!("{of}=\"")).unwrap();
            rest.split_once('"').unwrap().0.parse::<f64>().unwrap()
        };
        ([number("x"), number("y")], text.replace("&amp;", "&").len())
    });
    let names: Vec<_> = names.collect();
    assert!(names.len() >= 8 && names.len() < 40, "{}", names.len());
    for (place, ([x, y], letters)) in names.iter().enumerate() {
        let end = x + 5.0 * *letters as f64;
        assert!(*x >= 48.0 && end < 385.0);
        let apart = |([other, row], _): &([f64; 2], usize)| row != y || *other > end;
        assert!(names[place + 1..].iter().all(apart), "{names:?}");
    }
}

/// The vectors of a polar chart have equal scales, from one centre; a closed motion is a closed curve.
#[test]
fn vectors_from_one_centre() {
    let table = table().units(Units { length: "mm", ..Units::SI });
    let polar = Polar::of(&table, "C_acceleration_x", "C_acceleration_y").unwrap();
    assert_eq!((polar.title.as_str(), polar.radius.as_str()), ("C_acceleration", "[mm/s^2]"));
    let svg = polar.to_svg();
    parse(&svg);
    let curves = places(&svg);
    let [curve] = curves[0].as_slice() else { panic!("{curves:?}") };
    let number = |text: &str| text.split_once('"').unwrap().0.parse::<f64>().unwrap();
    let circles: Vec<[f64; 3]> = svg
        .split("<circle class=\"grid\"")
        .skip(1)
        .map(|rest| ["cx=\"", "cy=\"", "r=\""].map(|of| number(rest.split_once(of).unwrap().1)))
        .collect();
    let [x, y, radius] = *circles.last().unwrap();
    assert!(circles.len() >= 3 && circles.iter().all(|circle| circle[..2] == [x, y]));
    let [across, up] = ["C_acceleration_x", "C_acceleration_y"].map(|name| table.column(name).unwrap());
    let longest = across.iter().zip(up).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    // The label of the outermost circle.
    let labels = svg.split("middle mark\"").skip(1).map(|rest| rest.split_once('>').unwrap().1);
    let most: f64 = labels.last().unwrap().split_once('<').unwrap().0.parse().unwrap();
    assert!(longest <= most && longest > 0.7 * most, "{longest} {most}");
    let farthest = curve.iter().map(|at| (at[0] - x).hypot(at[1] - y)).fold(0.0, f64::max);
    close("scale", farthest / radius, longest / most, 0.2 / radius);
    let first = [x + across[0] * radius / most, y - up[0] * radius / most];
    for (drawn, expected) in curve[0].iter().zip(first) {
        close("first", *drawn, expected, 0.2);
    }
    assert_eq!(curve[0], *curve.last().unwrap());
    // Two curves have a legend.
    let two = polar.and(&table, "C_velocity_x", "C_velocity_y").unwrap();
    assert_eq!((two.curves.len(), two.curves[1].colour, two.has_legend), (2, 1, true));
    assert!(two.to_svg_fragment().contains(">C_velocity</text>") && STYLE.contains("prefers-color-scheme:dark"));
    assert!(!two.to_svg_fragment().contains("<style>") && two.to_svg().contains("<style>"));
}

/// One value is a dot; nothing, a column that does not exist and no column are errors.
#[test]
fn charts_of_little() {
    let mut one = Table::new(["x", "y", "z"]);
    one.push(&[1.0, 2.0, f64::NAN]);
    let chart = Chart::of(&one, "x", ["y"]).unwrap();
    assert_eq!(chart.curves[0].look, Look::Dots);
    let svg = chart.to_svg();
    assert!(svg.contains("<circle class=\"dot\"") && !svg.contains("NaN"));
    let polar = Polar::of(&one, "x", "y").unwrap();
    assert!(polar.to_svg().contains("<circle class=\"dot\"") && polar.title == "x, y");
    // The zero vector is at the centre.
    let zero = Polar::new("", "").curve("", [[0.0, 0.0]]).to_svg();
    assert!(!zero.contains("NaN") && !zero.contains("inf"));

    let nothing = |of: &[&str]| TableError::NoNumbers { columns: of.iter().map(|&name| name.to_owned()).collect() };
    assert_eq!(Chart::of(&one, "x", ["z"]).unwrap_err(), nothing(&["z", "x"]));
    assert_eq!(Polar::of(&one, "x", "z").unwrap_err(), nothing(&["x", "z"]));
    let empty = Table::new(["x", "y"]);
    let error = Chart::of(&empty, "x", ["y"]).unwrap_err();
    assert_eq!(error.to_string(), "no row has numbers in `y`, `x`: there is nothing to draw");
    assert_eq!(Chart::of(&one, "x", [] as [&str; 0]).unwrap_err(), TableError::NoColumns);
    let unknown = |name: &str, nearest: &str| TableError::UnknownColumn {
        name: name.to_owned(),
        nearest: Some(nearest.to_owned()),
    };
    let table = table();
    assert_eq!(Chart::of(&table, "theta", ["theta3"]).unwrap_err(), unknown("theta", "theta2"));
    assert_eq!(Chart::of(&table, "theta2", ["c_x"]).unwrap_err(), unknown("c_x", "C_x"));
    assert_eq!(Polar::of(&table, "C_x", "C_z").unwrap_err(), unknown("C_z", "C_x"));
    let polar = Polar::of(&table, "C_x", "C_y").unwrap();
    assert_eq!(polar.and(&table, "D_x", "C_y").unwrap_err(), unknown("D_x", "B_x"));
    // A chart without curves, made by hand, has axes only; so has one of a number that is not finite.
    for svg in [
        Polar::new("a", "b").to_svg(),
        Polar::new("a", "b").curve("c", [[f64::NAN, 1.0], [f64::INFINITY, 0.0]]).to_svg(),
    ] {
        parse(&svg);
        assert!(svg.contains("<circle class=\"grid\"") && !svg.contains("NaN"));
    }
}
