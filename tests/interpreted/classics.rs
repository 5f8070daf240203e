//! The classics as files: each is the mechanism of the gallery of its name, without what is for Rust.

use std::fs;
use std::path::Path;

use linkage_gallery::FILES;
use linkage_interpreter::Program;

use crate::at_run_time::mechanisms;
use crate::drawn::Drawn;

/// The calls of each function.
const CALLS: u64 = 5;

#[test]
fn files_are_the_mechanisms_of_the_gallery() {
    let folder = Path::new(linkage_tests::ROOT).join("examples/linkages");
    let (mut files, mut values) = (0, 0);
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a file").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        assert!(FILES.contains(&name.as_str()), "{name} is no file of the gallery");
        let text = fs::read_to_string(&path).expect("a text");
        let program = Program::compile(&text).unwrap_or_else(|messages| panic!("{name}: {messages:?}"));
        for (own, of_gallery) in program.mechanisms().iter().zip(mechanisms(&name)) {
            assert_eq!(own.name(), of_gallery.name(), "{name}");
            let designs = [own.design(), of_gallery.design()];
            assert_eq!(designs[0].by_name(), designs[1].by_name(), "{name}");
            for function in own.functions() {
                for call in 0..CALLS {
                    let mut drawn = Drawn::new(call, 0.0);
                    let arguments = designs[0].arguments(function).expect("its own function");
                    let arguments: Vec<_> =
                        arguments.iter().map(|of| drawn.argument(own, &designs[0], &of.shape)).collect();
                    let [own, other] = designs.each_ref().map(|design| design.call(function, &arguments));
                    assert_eq!(own, other, "{name}: {function}");
                    values += usize::from(own.is_ok());
                }
            }
        }
        files += 1;
    }
    assert!(files >= 12 && values > 1000, "{files} files, {values} values");
}
