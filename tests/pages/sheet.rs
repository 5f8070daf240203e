//! The sheet of the four-bar.

use linkage::Document;
use linkage::derivation::{Entry, FormulaMatrix, FormulaNode, FormulaTable};
use linkage::sheet::Sheet;

use linkage_gallery::cam_follower::*;
use linkage_gallery::cam_rocker::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::four_bar_effects;
use linkage_gallery::norton_four_bar::*;
use linkage_gallery::slider_crank_scenes::*;

const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 4 3\"><script>alert(1)</script>\
                   <path d=\"M0 0L3 2\" stroke=\"#b00\"/></svg>";

fn sheet() -> String {
    let mut sheet = Sheet::new(FourBar::DERIVATION);
    sheet
        .title("Four-bar <A&B> \"linkage\"")
        .parameter("l1", 80.0)
        .parameter("l2", 20.0)
        .numbers("Pose <rad>", [("theta3", 1.25), ("not a <symbol>", -0.5)])
        .numbers("Velocity", [("theta3/theta2", -0.1), ("theta3_rate", 2.0), ("det J", -1e-9)])
        .picture(SVG, "The pose & its \"path\"");
    sheet.to_html()
}

/// Every element that needs an end has one, in order.
pub(super) fn assert_balanced(html: &str) {
    const VOID: [&str; 4] = ["!DOCTYPE", "meta", "img", "br"];
    let mut open: Vec<&str> = Vec::new();
    for piece in html.split('<').skip(1) {
        let (tag, _) = piece.split_once('>').unwrap_or_else(|| panic!("no end of a tag at {piece}"));
        let name = tag.split_whitespace().next().unwrap_or_default();
        match name.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{tag}"),
            None if VOID.contains(&name) => {}
            None => open.push(name),
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn tags_are_balanced() {
    assert_balanced(&sheet());
    for derivation in [FourBar::DERIVATION, CamFollower::DERIVATION, CamRocker::DERIVATION] {
        assert_balanced(&Sheet::new(derivation).to_html());
    }
}

#[test]
fn the_file_stands_alone() {
    let html = sheet();
    assert!(html.starts_with("<!DOCTYPE html>") && html.contains("lang=\"en\"") && html.contains("name=\"viewport\""));
    for foreign in ["<script", "<link", "http:", "https:", "@import", "url(", " onload", "<svg"] {
        assert!(!html.contains(foreign), "{foreign}");
    }
}

#[test]
fn texts_of_users_are_escaped() {
    let html = sheet();
    assert!(html.contains("<h1>Four-bar &lt;A&amp;B&gt; &quot;linkage&quot;</h1>"));
    assert!(html.contains("<caption>Pose &lt;rad&gt;</caption>"));
    assert!(html.contains("<th scope=\"row\">not a &lt;symbol&gt;</th><td>−0.5"));
    assert!(html.contains("alt=\"The pose &amp; its &quot;path&quot;\""));
    assert!(!html.contains("<A&B>") && !html.contains("<symbol>"));
}

#[test]
fn numbers_are_next_to_formulas() {
    let html = sheet();
    let row = |name: &str| format!("<th scope=\"row\"><math>{name}</math></th>");
    let theta = |index: u8| format!("<msub><mi>θ</mi><mn>{index}</mn></msub>");
    let ratio = format!("<mfrac><mrow><mo>∂</mo>{}</mrow><mrow><mo>∂</mo>{}</mrow></mfrac>", theta(3), theta(2));
    assert!(html.contains(&row("<msub><mi>l</mi><mn>1</mn></msub>")));
    assert!(html.contains(&row(&theta(3))) && html.contains(&row(&ratio)));
    assert!(html.contains(&row("<msub><mover><mi>θ</mi><mo>˙</mo></mover><mn>3</mn></msub>")));
    assert!(html.contains(&format!(
        "{}<td>−1·10⁻⁹",
        row("<mrow><mi>det</mi><mo rspace=\"0.17em\">\u{2061}</mo><mi>J</mi></mrow>")
    )));
}

#[test]
fn equations_are_numbered_as_in_the_text() {
    let html = sheet();
    let orders = Sheet::new(NortonFourBar::DERIVATION).to_html();
    assert_balanced(&orders);
    for (html, derivation) in [(&html, FourBar::DERIVATION), (&orders, NortonFourBar::DERIVATION)] {
        let last = derivation.to_text().matches("\n  (").count();
        assert!(html.contains(&format!("id=\"equation-{last}\"")));
        assert!(!html.contains(&format!("id=\"equation-{}\"", last + 1)));
    }
    assert!(html.contains("href=\"#equation-2\""));
}

#[test]
fn large_matrices_are_lists_of_entries() {
    let table: &FormulaTable =
        Box::leak(Box::new(FormulaTable::checked(&[FormulaNode::Integer(1)], &[], &[]).unwrap()));
    let entries = Box::leak(Box::new([Entry { row: 6, column: 0, value: table.get(1).unwrap() }]));
    let mut large = *FourBar::DERIVATION;
    let name = FourBar::DERIVATION.jacobian_inputs.name;
    large.jacobian_inputs = FormulaMatrix { name, factor: None, rows: 7, columns: 1, entries };
    let html = Sheet::new(&large).to_html();
    assert_balanced(&html);
    assert!(html.contains("<mrow><mn>7</mn><mo>,</mo><mn>1</mn></mrow></msub><mo>=</mo><mn>1</mn>"));
}

/// The sections of scenes follow those of the mechanism, and their equations continue its numbers.
#[test]
fn scenes_have_sections_of_their_own() {
    let mut sheet = Sheet::new(Crank::DERIVATION);
    sheet.scene(Turning::DERIVATION).scene(Steady::DERIVATION).scene(Worn::DERIVATION);
    let html = sheet.to_html();
    assert_balanced(&html);
    for scene in ["Turning", "Steady"] {
        assert!(html.contains(&format!("<h2>Equations of motion: <code>{scene}</code></h2>")), "{scene}");
        assert!(html.contains(&format!("<h2>Operations: <code>{scene}</code></h2>")), "{scene}");
    }
    for effect in Turning::DERIVATION.forces {
        assert!(html.contains(&format!("<h3>{}</h3>", effect.name)), "{}", effect.name);
    }
    for joint in Worn::DERIVATION.joints {
        assert!(html.contains(&format!("<h3>{}</h3>", joint.name)), "{}", joint.name);
    }
    assert_eq!(html.matches("<h2>Forces in joints").count(), 1);
    let numbers = html.match_indices("class=\"number\">(").map(|(at, found)| {
        let rest = &html[at + found.len()..];
        rest[..rest.find(')').unwrap_or(0)].parse::<usize>().unwrap()
    });
    let numbers: Vec<usize> = numbers.collect();
    let of_forces: usize = Turning::DERIVATION.forces.iter().map(|effect| effect.forces.len()).sum();
    assert!(numbers.len() > of_forces && numbers.iter().copied().eq(1..=numbers.len()), "{numbers:?}");
}

/// A sheet with scenes shows their frictions, stops and drives.
#[test]
fn scenes_with_all_effects() {
    let mut sheet = Sheet::new(four_bar_effects::FourBar::DERIVATION);
    sheet.scene(four_bar_effects::Everything::DERIVATION).scene(four_bar_effects::Driven::DERIVATION);
    let html = sheet.to_html();
    assert_balanced(&html);
    for effect in ["body rocker", "spring on theta4", "torque on theta2", "friction on theta4", "stop on theta4"] {
        assert_eq!(html.matches(&format!("<h3>{effect}</h3>")).count(), if effect == "body rocker" { 2 } else { 1 });
    }
    let limit = "<mrow><mi>μ</mi><mo>⋅</mo><mi>radius</mi><mo>⋅</mo><mi>load</mi></mrow>";
    assert!(html.contains(limit) && html.contains("<mo>≤</mo><msub><mi>s</mi><mn>2</mn></msub><mo>≤</mo>"));
    assert!(html.contains("At an impact the rate of s is multiplied by") && html.contains("The driven inputs move by"));
}
