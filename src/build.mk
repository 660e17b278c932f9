# build.mk - how the renderer is compiled. Included by the Makefile beside src/,
# here and in the student edition.
#
#   CC=gcc|clang   OPT=release|debug|asan
#   VARIANT=dir    files of dir/src/ in place of the same files in src/
#   TODO="a b"     these exercises as stubs: -DTODO_a -DTODO_b
#   CHECK=yes      as `make check` builds: quick to link, warnings are no errors
#
# Objects go to build/obj/<configuration>/. The plain configuration's program is
# build/raybook; any other's is build/bin/raybook-<configuration>.

VERSION := 0.1.0
ifeq ($(origin CC),default)
  CC := gcc
endif
OPT ?= release
VARIANT ?=
TODO ?=
ARCH ?= native
CHECK ?=
# What the renderer uses unless --accel names another: the wide tree, but the
# course's own BVH where something may be a student's.
ACCEL ?= $(if $(VARIANT)$(TODO)$(CHECK)$(filter kit,$(config)),bvh,wide)

empty :=
space := $(empty) $(empty)
variant_name := $(notdir $(patsubst %/,%,$(VARIANT)))
config := $(OPT)-$(notdir $(CC))$(if $(filter-out native,$(ARCH)),-$(ARCH))
config := $(config)$(if $(CHECK),-check)
# A folder's name has an end: of many exercises it holds a number in place of them.
todo_names := $(sort $(TODO))
todo_name := $(if $(word 6,$(todo_names)),$(words $(todo_names))-$(firstword \
    $(shell echo '$(todo_names)' | cksum)),$(subst $(space),+,$(todo_names)))
config := $(config)$(if $(TODO),-todo-$(todo_name))
config := $(config)$(if $(VARIANT),-variant-$(variant_name))
objdir := build/obj/$(config)
bindir := build/bin
program := $(if $(filter release-gcc,$(config)),build/raybook,$(bindir)/raybook-$(config))

# Contraction (a*b+c in one rounding) is off everywhere: results must not depend
# on the compiler's mood, and edge functions of degenerate triangles must be 0.
warnings := -std=c99 -Wall -Wextra -Wpedantic -Werror
common := $(warnings) -Isrc -fopenmp -ffp-contract=off -fno-math-errno
release := -O3 -march=$(ARCH)
debug := -O0 -g3
asan := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all \
        -fno-omit-frame-pointer
# Modules are files; only link-time optimisation can inline one into another.
# Where gcc 12 knows which registers a callee leaves alone (ipa-ra), it leaves
# the upper halves of vectors in use, and the C library's mathematics is slow.
# The limits are raised until a box's test is part of the walk through a tree.
inlining := --param=max-inline-insns-auto=80 --param=max-inline-insns-single=400 \
    --param=large-function-growth=400 --param=inline-unit-growth=200
lto := $(if $(filter release-gcc,$(OPT)-$(notdir $(CC))$(CHECK)), \
    -flto=auto -fno-ipa-ra $(inlining))

# -isystem: the warnings are for our code.
libraries_cflags := $(patsubst -I%,-isystem%,$(filter -I%,$(shell \
    pkg-config --cflags OpenEXR libcjson stb 2>/dev/null)))
ldlibs := $(shell pkg-config --libs-only-L OpenEXR libcjson stb 2>/dev/null) \
    $(filter -lOpenEXRCore%,$(shell pkg-config --libs OpenEXR 2>/dev/null)) \
    -lcjson -lm

# Embree, if it is there: it has no pkg-config file. EMBREE=no builds without.
EMBREE ?= $(if $(CHECK),no,$(if $(shell echo '\#include <embree3/rtcore.h>' | $(CC) -E -x c - 2>/dev/null),yes,no))
ifeq ($(EMBREE),yes)
  libraries_cflags += -DRAYBOOK_EMBREE
  ldlibs += -lembree3
endif

cflags = $(common) $($(filter release debug asan,$(OPT))) $(lto) $(libraries_cflags) \
    $(patsubst %,-DTODO_%,$(TODO)) $(if $(CHECK),-Wno-error) $(CFLAGS)
ldflags = -fopenmp $($(filter release debug asan,$(OPT))) $(lto) $(LDFLAGS)

sources := $(shell find src -name '*.c' ! -name 'test_*' | LC_ALL=C sort)
ifneq ($(EMBREE),yes)
  sources := $(filter-out src/accel/embree.c,$(sources))
endif
tests := $(sort $(wildcard src/*/test_*.c assignments/*/test_*.c))
objects := $(sources:src/%.c=$(objdir)/%.o)
stamp := $(objdir)/flags.stamp

$(program): $(objects)
	@mkdir -p $(@D)
	$(quiet_link) $(CC) $(ldflags) $^ $(ldlibs) -o $@

ifneq ($(VARIANT),)
# A variant's object may define its contract's symbols (those of the file that it
# replaces) and nothing more: every other name becomes local to it.
$(objdir)/%.o: $(VARIANT)/src/%.c src/%.c $(stamp)
	@mkdir -p $(@D)
	$(CC) $(filter-out -flto%,$(cflags)) -MMD -MP -c $(VARIANT)/src/$*.c -o $@.all
	@$(CC) $(filter-out -flto%,$(cflags)) -c src/$*.c -o $@.contract
	@nm --defined-only --extern-only --format=posix $@.contract | cut -d' ' -f1 > $@.symbols
	@objcopy --keep-global-symbols=$@.symbols $@.all $@
endif

# Others' code. It is kept out of the above, since what gcc would then think of it
# is no error of ours; it shifts into the sign here and there; memory is watched.
$(objdir)/image/stb_library.o: private lto :=
$(objdir)/image/stb_library.o: cflags += $(if $(filter asan,$(OPT)),-fno-sanitize=undefined)

$(objdir)/main.o $(objdir)/program/results.o: cflags += -DRAYBOOK_VERSION='"$(VERSION)"' \
    -DRAYBOOK_VARIANT='"$(or $(variant_name),reference)$(TODO:%= TODO_%)"'
$(objdir)/program/options.o: cflags += -DRAYBOOK_ACCEL='"$(ACCEL)"'
$(objdir)/%.o: src/%.c $(stamp)
	@mkdir -p $(@D)
	$(quiet_cc) $(CC) $(cflags) -MMD -MP -c $< -o $@

# Changes when the flags do, so that objects made with others are made again.
$(stamp): FORCE
	@mkdir -p $(@D)
	@printf '%s\n' '$(CC) $(VERSION) $(ACCEL) $(cflags)' | cmp -s - $@ || \
	    printf '%s\n' '$(CC) $(VERSION) $(ACCEL) $(cflags)' > $@

# One program for each test file: Unity, the test, and all objects but main's.
unity := $(or $(UNITY_ROOT),build/unity)
testdir := build/test/$(config)
# What a test said before it crashed is not lost.
unity_flags := -isystem $(unity) -DUNITY_INCLUDE_DOUBLE -DUNITY_USE_FLUSH_STDOUT
# gcc takes what a test asserts for something that may not have happened.
test_warnings := $(if $(findstring gcc,$(CC)),-Wno-maybe-uninitialized)
test_programs := $(patsubst %.c,$(testdir)/%,$(tests))

$(testdir)/%: %.c $(filter-out $(objdir)/main.o,$(objects)) $(unity)/unity.c
	@mkdir -p $(@D)
	$(quiet_cc) $(CC) $(filter-out -Wpedantic -Werror,$(cflags)) $(test_warnings) $(unity_flags) -MMD -MP \
	    -MF $@.d $< $(unity)/unity.c $(filter %.o,$^) $(ldlibs) -o $@

# What a test program outside of src/ is made with and linked with.
list-objects: $(objects)
	@echo $(filter-out $(objdir)/main.o,$(objects))
list-compiler:
	@echo $(CC) $(cflags)
list-libraries:
	@echo $(ldlibs)

unit-tests: $(test_programs)
	@for test in $^; do \
	    $$test > $$test.log 2>&1 || { cat $$test.log; exit 1; }; \
	    echo "$${test#$(testdir)/}: $$(tail -n 2 $$test.log | head -n 1)"; \
	done

# The renderer and the tests named in TESTS, built; the last line says where.
programs: $(program) $(TESTS:%.c=$(testdir)/%)
	@echo $^

# What clangd needs to know; made again when a source file comes or goes.
compile_commands.json: $(stamp) src/build.mk
	@{ printf '['; comma=''; for file in $(sources) $(tests); do \
	    printf '%s\n{"directory": "%s", "file": "%s", "command": "%s -c %s"}' "$$comma" \
	        "$(CURDIR)" "$$file" '$(CC) $(filter-out $(lto),$(cflags)) $(unity_flags)' "$$file"; \
	    comma=','; done; printf '\n]\n'; } > $@.new
	@mv $@.new $@

# The scripts leave alone what is up to date.
build/meshes/done: $(wildcard scenes/*.py)
	@python3 scenes/make_meshes.py build/meshes
	@python3 scenes/make_images.py build/images
	@touch $@

# SCENE and ARGS are the caller's.
render-scenes: $(program) build/meshes/done
	@mkdir -p build/out
	@for scene in $(SCENE); do \
	    name=$$(basename $$scene .json); \
	    $(program) $$scene -o build/out/$$name.exr --png build/out/$$name.png \
	        --stats build/out/$$name.stats.json $(ARGS) || exit; \
	done

# V=1 shows the commands themselves.
ifndef V
  quiet_cc = @echo "  compile $<";
  quiet_link = @echo "  link $@";
endif

FORCE:
.PHONY: FORCE unit-tests programs list-objects list-compiler list-libraries \
    render-scenes
-include $(objects:.o=.d) $(test_programs:=.d)
