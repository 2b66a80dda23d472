# A thin front for the CMake presets. On a fresh machine ./demo and ./test install what is needed first.
.PHONY: build test bench check clean configure

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

check: configure
	tools/check-format
	tools/check-includes
	tools/check-dependencies
	cmake --build --preset release
	tools/check-tidy
	ctest --preset release

clean:
	rm -rf build
