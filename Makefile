# A thin front for people: CMake does the building. `make help` lists what there is.
BUILD   := build
PREFIX  ?= /usr/local
DESTDIR ?=
JOBS    ?= $(shell nproc)

all: configure
	@cmake --build $(BUILD) --parallel $(JOBS)

# Ninja where it is installed; a build directory keeps what it was made with.
configure: $(BUILD)/CMakeCache.txt
$(BUILD)/CMakeCache.txt:
	@cmake --preset release $$(scripts/generator.sh)

setup:
	@scripts/setup.sh build

demo: setup
	@$(MAKE) --no-print-directory all
	@scripts/demo.sh $(BUILD)/drypoint

check:
	@scripts/setup.sh check
	@scripts/check.sh

check-all sanitize: check

install: all
	@cmake --install $(BUILD) --prefix "$(PREFIX)"

clean:
	rm -rf $(BUILD)

.PHONY: all configure setup demo check check-all sanitize install clean
