# carvel: `make demo` shows what it does, `make test` checks everything, `make install`
# puts the library where C and C++ programs find it.

CARGO ?= cargo
FUZZ_SECONDS ?= 60
FUZZ_TARGETS = read_obj read_off read_ply read_stl build_mesh capi

# Where `make install` puts things; packaging/install.sh lists all variables.
PREFIX ?= /usr/local
PROFILE ?= release
LIB = out/lib/$(PROFILE)
export PREFIX DESTDIR LIBDIR INCLUDEDIR STRIP_DEBUG

COMPARED = $(if $(MESH),--mesh '$(MESH)') $(if $(LEVEL),--level '$(LEVEL)') $(COMPARE_FLAGS)

.PHONY: demo test count-record lint deep mutants fuzz bench compare abi-record lib install uninstall tools test-tools clean

# Refines the cow, a creased cube and the founding paper's torus into out/.
demo: tools
	$(CARGO) build --release --locked
	assets/demo.sh

# Format, lints, every test, the documentation's examples, the lean build, instructions.
test: test-tools lint
	$(CARGO) test --workspace --all-features --locked
	$(CARGO) build --locked --no-default-features
	OUT=out/test CARVEL=target/debug/carvel assets/demo.sh
	$(CARGO) run --profile counted --locked --quiet -p carvel-instructions

# Records the instructions per face of the main paths after a change that is meant.
count-record: test-tools
	$(CARGO) run --profile counted --locked --quiet -p carvel-instructions -- --record

lint: tools
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-features --locked --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --all-features --locked --no-deps --lib --quiet

# Minutes of work: more random meshes, a large mesh, fuzzing.
deep: tools
	PROPTEST_CASES=512 CARVEL_PEER_LEVELS=5 $(CARGO) test --workspace --all-features --release --locked
	$(CARGO) test --all-features --release --locked --test limit -- --ignored --nocapture
	tests/capi/tsan.sh
	$(CARGO) build --release --locked
	mkdir -p out/deep
	target/release/carvel subdivide assets/spot/spot_control_mesh.obj \
	    -o out/deep/large.obj --levels 7 --json
	target/release/carvel subdivide out/deep/large.obj -o out/deep/larger.ply --levels 1 --json
	$(CARGO) bench --all-features --locked --no-run
	$(MAKE) --no-print-directory fuzz

# Breaks the schemes and splits in every way that cargo-mutants knows: many hours of
# work. MUTANTS='--shard 0/10' or '--file src/scheme/smooth.rs --no-config' for a part.
mutants:
	@cargo mutants --version >/dev/null 2>&1 || \
	    { echo "cargo-mutants is missing: cargo install cargo-mutants --locked"; exit 1; }
	mkdir -p out
	CARGO_PROFILE_DEV_DEBUG=0 $(CARGO) mutants --output out $(MUTANTS)

# FUZZ_SECONDS on each reader and on mesh construction.
fuzz:
	@if cargo +nightly fuzz --version >/dev/null 2>&1; then \
	    set -e; for target in $(FUZZ_TARGETS); do \
	        mkdir -p fuzz/corpus/$$target; \
	        cargo +nightly fuzz run $$target fuzz/corpus/$$target fuzz/seeds/$$target -- \
	            -max_total_time=$(FUZZ_SECONDS); \
	    done; \
	else \
	    echo "SKIPPED: fuzzing needs a nightly toolchain and cargo-fuzz (cargo install cargo-fuzz)"; \
	fi

# Speed; results with date and machine are kept in benches/README.md.
bench: tools
	$(CARGO) bench --all-features --locked

# Answers, speed and memory beside OpenSubdiv, OpenMesh and CGAL, into out/compare.json;
# MESH=file.obj LEVEL=3 for a mesh of one's own, COMPARE_FLAGS='--part threads' for a part.
compare: test-tools
	$(CARGO) run --release --locked --quiet -p carvel-peers --bin compare -- $(COMPARED)

# Records the C interface after a change that docs/abi.md allows.
abi-record: test-tools
	CARVEL_RECORD_ABI=1 $(CARGO) test --locked -p carvel-capi-tests --test abi recorded

# The C library, shared and static. `sudo make install` after it runs no cargo.
lib: $(LIB)/facts

$(LIB)/facts: Cargo.toml Cargo.lock build.rs packaging/build.sh packaging/merge.sh \
    $(shell find src -name '*.rs')
	CARGO='$(CARGO)' packaging/build.sh '$(LIB)' '$(PROFILE)'

install: lib
	packaging/install.sh install '$(LIB)'

uninstall:
	packaging/install.sh uninstall

tools:
	@assets/install.sh

test-tools:
	@assets/install.sh tests

clean:
	$(CARGO) clean
	rm -rf out
