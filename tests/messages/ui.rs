//! Error messages: text and place of each. `TRYBUILD=overwrite` accepts new ones.

#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("messages/ui/*.rs");
}
