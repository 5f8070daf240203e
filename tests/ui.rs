//! Mistakes of users: what each message says and where it points. `TRYBUILD=overwrite` accepts new ones.

#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("tests/ui/*.rs");
}
