//! The linker's map of each board, and the demonstration's rest data for flash.

use std::path::PathBuf;
use std::{env, fs};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let riscv = env::var("CARGO_CFG_TARGET_ARCH")? == "riscv32";
    // The demonstration gets the 20 KB that it is meant for, the proofs what they like.
    for (name, ram) in [("small", "20K"), ("large", "1M")] {
        let map = if riscv {
            RISCV.to_string()
        } else {
            format!(
                "MEMORY {{ FLASH : ORIGIN = 0x00000000, LENGTH = 1M\n RAM : ORIGIN = 0x20000000, LENGTH = {ram} }}\n"
            )
        };
        let folder = out.join(name);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join("memory.x"), map)?;
        let binaries: &[&str] = if name == "small" { &[] } else { &["bits"] };
        for binary in binaries {
            println!("cargo:rustc-link-arg-bin={binary}=-L{}", folder.display());
        }
    }
    println!("cargo:rerun-if-changed=build.rs");
    Ok(())
}

/// QEMU's `virt` has RAM alone.
const RISCV: &str =
    "MEMORY { FLASH : ORIGIN = 0x80000000, LENGTH = 1M\n RAM : ORIGIN = 0x80100000, LENGTH = 1M }
REGION_ALIAS(\"REGION_TEXT\", FLASH);
REGION_ALIAS(\"REGION_RODATA\", FLASH);
REGION_ALIAS(\"REGION_DATA\", RAM);
REGION_ALIAS(\"REGION_BSS\", RAM);
REGION_ALIAS(\"REGION_HEAP\", RAM);
REGION_ALIAS(\"REGION_STACK\", RAM);
";
