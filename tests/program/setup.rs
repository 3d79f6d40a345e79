//! The shell scripts that new machines and tests on others depend on.

use std::path::Path;
use std::process::Command;

#[test]
fn scripts_pass_shellcheck() {
    for script in ["setup.sh", ".ci/run", "tests/distributions/run", "docs/animate.slurm"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(script);
        let check = Command::new("shellcheck")
            .arg(path)
            .output()
            .unwrap_or_else(|error| panic!("could not run shellcheck ({error}); ./setup.sh installs it"));
        assert!(check.status.success(), "{}", String::from_utf8_lossy(&check.stdout));
    }
}
