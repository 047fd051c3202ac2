# A thin front for people: CMake does the building. `make help` lists what there is.
BUILD   := build
PREFIX  ?= /usr/local
DESTDIR ?=
PORT    ?= 8000
JOBS    ?= $(shell nproc 2>/dev/null || echo 1)
export DESTDIR JOBS

# The C sources that are ours, for the formatter.
SOURCES  = $$(git ls-files '*.c' '*.h' '*.inc')

all: $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) --parallel $(JOBS)

$(BUILD)/CMakeCache.txt:
	@cmake --preset release $$(scripts/generator.sh) || { rm -f $@; \
		echo 'make: not configured; `make setup` installs what is missing' >&2; exit 1; }

help:
	@echo 'make            build build/drypoint and build/libdrypoint.{a,so}'
	@echo 'make demo       install what is missing, build, and draw demo.png'
	@echo 'make check      install what is missing, build in all ways, run all tests'
	@echo 'make test       build and run the tests once, without sanitizers and fuzzers'
	@echo 'make check-gl   run the tests of drawings by OpenGL under the sanitizers, by Mesa without a window'
	@echo 'make sanitize   run the tests under the sanitizers and in the hostile build'
	@echo 'make fuzz       run every fuzzer for long: MINUTES=10 each'
	@echo 'make mutants    plant faults, list those no quick test notices: SEED=1 FAULTS=100 ONLY=N'
	@echo 'make accuracy   score pictures against exact lines'
	@echo 'make twins      compare random scenes with their twins: SEEDS=10000 FROM=0 KIND=fan,star'
	@echo 'make bench      time frames, ten minutes long, beside Mesa; BENCH_QUICK=1: two'
	@echo 'make bench-big  draw a 5 GB file; TRIANGLES=2000000 makes it smaller'
	@echo 'make web        install what is missing and build the page for browsers, build/web'
	@echo 'make serve      build the page if it is not there and show it: PORT=8000'
	@echo 'make check-web  test the page in Chromium, and its WebAssembly in node'
	@echo 'make gallery    draw the pictures of docs/gallery again'
	@echo 'make wheel      make the Python package, build/python/dist/*.whl'
	@echo 'make install    install below PREFIX=/usr/local'
	@echo 'make uninstall  remove what make install put there'
	@echo 'make deb        install what is missing, and build Debian packages in build/deb'
	@echo 'make setup      only install what is missing to build'
	@echo 'make format     format the C sources; make format-check only looks'
	@echo 'make clean      remove the build directory'

setup:
	@scripts/setup.sh build

setup-check:
	@scripts/setup.sh check

demo: setup
	@$(MAKE) --no-print-directory all
	@scripts/demo.sh $(BUILD)/drypoint

check check-all: setup-check
	@scripts/check.sh

test: setup-check
	@scripts/check.sh gcc

check-gl: setup-check
	@scripts/check.sh gl

sanitize: setup-check
	@scripts/check.sh asan tsan hostile

fuzz: setup-check
	@scripts/fuzz.sh

mutants: setup-check
	@scripts/mutants.py $(SEED:%=--seed %) $(FAULTS:%=--faults %) $(ONLY:%=--only %) $(WIDE:%=--wide)

accuracy: setup-check
	@scripts/accuracy.sh

twins: setup-check
	@scripts/twins.sh $(SEEDS:%=--seeds %) $(FROM:%=--from %) $(KIND:%=--kind %)

bench: setup
	@$(MAKE) --no-print-directory all
	@scripts/bench.sh $(BUILD)/drypoint

bench-big: setup
	@$(MAKE) --no-print-directory all
	@scripts/bench-big.sh $(BUILD)/drypoint $(TRIANGLES)

gallery: setup
	@$(MAKE) --no-print-directory all
	@scripts/gallery.sh $(BUILD)/drypoint

wheel: setup
	@scripts/wheel.sh $(BUILD)

web:
	@scripts/setup.sh web
	@scripts/web.sh

serve:
	@[ -e build/web/index.html ] || $(MAKE) --no-print-directory web
	@node web/serve.mjs --port $(PORT)

check-web: setup-check
	@scripts/check.sh web

install: all
	@cmake --install $(BUILD) --prefix "$(PREFIX)"

# What was installed last, by CMake's manifest.
uninstall:
	@cmake -DBUILD=$(BUILD) -P cmake/Uninstall.cmake

deb:
	@scripts/setup.sh deb
	@scripts/deb.sh

format:
	@clang-format -i $(SOURCES)

format-check:
	@clang-format --dry-run -Werror $(SOURCES)

clean:
	rm -rf $(BUILD)

.PHONY: all help setup setup-check demo check check-all check-gl test sanitize fuzz mutants accuracy twins bench bench-big gallery \
        web serve check-web wheel install uninstall deb format format-check clean
