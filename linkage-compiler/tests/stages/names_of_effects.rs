//! Effects with equal names are numbered, so that an error names one of them.

use proc_macro2::TokenStream;

#[test]
fn effects_of_equal_names_are_numbered() {
    let text = "mechanism M {
        param l = 3, m = 1, j = 1;
        input phi;
        point P = l@phi;
        body rod { mass m; inertia j; center P; angle phi; }
        scene Motion {
            inertia;
            spring 2 on phi;
            torque 3 on phi;
            spring 3 on phi;
            potential m * norm(P - (0, 1)) + phi;
            stop x(P) * y(P) * phi^2 * l * m in -1..1, restitution 0;
            stop x(P) * y(P) * phi^2 * l * j in -1..2, restitution 0.2;
            stop phi in -2..2, restitution 0;
            friction 3 on phi;
            friction x(P) * y(P) on phi;
        }
    }";
    let mechanisms = linkage_compiler::read(text.parse::<TokenStream>().unwrap()).unwrap();
    let scene = &mechanisms[0].scenes[linkage_compiler::ids::Id::new(0)];
    let mut laws: Vec<&str> = scene.laws.iter().map(|law| law.label.as_str()).collect();
    laws.dedup();
    // Both laws of the potential have its name.
    assert_eq!(scene.laws.len(), 5);
    assert_eq!(laws, ["spring 1 on phi", "torque on phi", "spring 2 on phi", "potential an expression"]);
    let contacts: Vec<&str> = scene.contacts.iter().map(|contact| contact.label.as_str()).collect();
    assert_eq!(
        contacts,
        ["stop 1 on an expression", "stop 2 on an expression", "stop on phi", "friction 1 on phi", "friction 2 on phi"]
    );
}
