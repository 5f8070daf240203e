//! The groups of unknowns of every mechanism in the order in which they are solved: Assur dyads, and larger groups
//! without a closed form.

use linkage_gallery::{FILES, source};

#[test]
fn assur_groups() {
    let groups_of = |file: &&str| {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        let derivations = linkage_compiler::derive(&mechanism);
        let drivers: Vec<String> = derivations
            .iter()
            .map(|derivation| {
                let groups = derivation.groups.iter().map(|group| format!("{:?}", group.kind));
                groups.collect::<Vec<_>>().join(" ")
            })
            .collect();
        let groups = if mechanism.is_open() { "open chain".to_owned() } else { drivers.join(" | ") };
        format!("{file:22} {groups}")
    };
    insta::assert_snapshot!(FILES.iter().map(groups_of).collect::<Vec<_>>().join("\n"));
}
