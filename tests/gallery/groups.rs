//! How the positions of the gallery are taken apart.

use super::source;

/// The groups of unknowns in the order in which they are solved: dyads where an engineer sees dyads, a slider on
/// a line along an axis by itself, and what cannot be taken apart whole.
#[test]
fn assur_groups() {
    let groups: [(&str, &str); 32] = [
        ("andrews", "Rrr Rrr Rrr"),
        ("cam_follower", "Linear"),
        ("cam_rocker", "Linear Rrr"),
        ("cardan", "Linear"),
        ("chebyshev", "Rrr"),
        ("coupled_wheels", "Rrr"),
        ("crank_shaper", "Rpr Angle Linear"),
        ("double_butterfly", "Irreducible(6)"),
        ("elliptic_trammel", "Linear Linear"),
        ("five_bar", "Rrr"),
        ("four_bar", "Rrr"),
        ("geared_five_bar", "Linear Rrr"),
        ("geneva", "Rpr"),
        ("hart", "Rrr Rrr"),
        ("hoecken", "Rrr"),
        ("inverted_slider_crank", "Rpr"),
        ("jansen", "Rrr Rrr Rrr Rrr Rrr"),
        ("klann", "Rrr Rrr"),
        ("offset_slider_crank", "Angle Linear"),
        ("pantograph", "Rrr Rrr"),
        ("peaucellier", "Rrr Rrr Rrr"),
        ("roberts", "Rrr"),
        ("scotch_yoke", "Linear"),
        ("stephenson_i", "Rrr Rrr"),
        ("stephenson_ii", "Irreducible(4)"),
        ("stephenson_iii", "Rrr Rrr"),
        ("v_twin", "Rrp Rrp"),
        ("watt_i", "Rrr Rrr"),
        ("watt_ii", "Rrr Rrr"),
        ("watt_line", "Rrr"),
        ("whitworth", "Rpr Angle Linear"),
        ("wiper", "Rrr Rrr"),
    ];
    for (file, expected) in groups {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        let derivation = linkage_compiler::derive(&mechanism).remove(0);
        let found: Vec<String> = derivation.blocks.iter().map(|block| format!("{:?}", block.group)).collect();
        assert_eq!(found.join(" "), expected, "{file}");
    }
}
