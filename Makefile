# A thin front for the CMake presets. On a fresh machine ./demo and ./test install what is needed first.
.PHONY: build test bench docs check clean configure

build: configure
	cmake --build --preset release --target incognita_program

configure:
	@cmake --preset release --log-level=WARNING

test: configure
	cmake --build --preset release
	ctest --preset release

BENCHES = $(shell sed -n 's/^ *incognita_bench(\([A-Za-z0-9_]*\).*/\1/p' bench/*.cmake 2>/dev/null)
bench: configure
	cmake --build --preset release
	@set -e; for bench in $(BENCHES); do echo "== $$bench"; build/$$bench; done

# Numbers and pictures of README.md and docs/; what measures time: tools/make-docs --timed, after `make bench`
docs: build
	cmake --build --preset release --target patch_error
	tools/make-docs

check: configure
	tools/check-format
	tools/check-includes
	tools/check-dependencies
	cmake --build --preset release
	tools/check-tidy
	ctest --preset release

clean:
	rm -rf build
