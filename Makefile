# Raybook: a literate teaching ray tracer and the harness that grades a course
# built on it. `make help` lists what can be made; src/build.mk says how the
# renderer is compiled and what CC, OPT, VARIANT and TODO do.

.DEFAULT_GOAL := $(if $(VARIANT)$(TODO),build,help)
MAKEFLAGS += --no-print-directory

include src/build.mk

SCENE ?= $(filter-out %.schema.json,$(sort $(wildcard scenes/*.json)))
ARGS ?=
OUT ?=
A ?=
REVEAL ?=
HINT ?=
PIXEL ?=
STRICT ?=
SUBMISSIONS ?=
python := build/venv/bin/python
# For the makes below that compile; a caller's own -j goes before.
jobs := $(if $(filter -j%,$(MAKEFLAGS)),,-j$(shell nproc))
student := $(python) -m raybook_grader.student
grader := build/venv/bin/raybook-grader

help: ## this list
	@echo "Raybook $(VERSION): make <target>"
	@sed -n 's/^\([a-z][a-z_.-]*\):.*## \(.*\)/  \1|\2/p' $(MAKEFILE_LIST) | \
	    awk -F'|' '{ printf "%-24s%s\n", $$1, $$2 }'
	@echo "  CC=gcc|clang OPT=release|debug|asan VARIANT=dir TODO=\"names\" V=1"

setup: ## installs what is missing: system packages, build/venv, Unity
	@.setup/setup.sh

build: $(program) ## compiles the renderer; says where it is
	@echo "$(program)"

# The set-up comes first, in a make of its own: what the second make reads
# (pkg-config) may only be there after it.
render: ## [SCENE=file.json] [ARGS="--spp 16"] draws the demo scenes and a contact sheet into build/out/
	@.setup/setup.sh
	@$(MAKE) $(jobs) render-scenes
	@$(if $(word 2,$(SCENE)),$(python) scenes/contact_sheet.py build/out/contact-sheet.png $(SCENE))

test: ## every test: format, C (Unity, also with sanitizers), Python, end to end
	@.setup/setup.sh
	@.setup/setup.sh book
	@$(MAKE) check-format check-python
	@$(MAKE) $(jobs) unit-tests
	@$(MAKE) $(jobs) unit-tests OPT=asan
	@$(MAKE) $(jobs) -s $(program) build/meshes/done compile_commands.json kit
	@$(python) -m pytest -q -n auto --dist loadfile $(ARGS)

format: ## writes the C files in the house style (.clang-format)
	@clang-format -i $(c_files)

check-format:
	@clang-format --dry-run --Werror $(c_files)

check-python:
	@build/venv/bin/ruff check --quiet grader
	@build/venv/bin/mypy --config-file grader/pyproject.toml --no-error-summary

c_files = $(shell find src assignments grader -name '*.[ch]' | LC_ALL=C sort)

check: ## [A=03] [VARIANT=dir] [TODO="names"] the student's own loop: public tests and pictures
	@.setup/setup.sh
	+@$(student) check --assignment "$(A)" $(if $(STRICT),--strict)

watch: ## A=03 checks again on every save
	@.setup/setup.sh
	+@$(student) watch --assignment "$(A)"

hint: ## A=03 [HINT=1] the next hint for a student, or one again
	@.setup/setup.sh
	@$(student) hint --assignment "$(A)" $(if $(HINT),--again "$(HINT)")

# SCENE has a default here, which is not meant.
debug: ## A=03 or SCENE=file.json, PIXEL=x,y: that pixel's paths, and where VARIANT's differ
	@.setup/setup.sh
	+@$(student) debug --assignment "$(A)" --pixel "$(PIXEL)" \
	    --scene "$(if $(filter command line,$(origin SCENE)),$(SCENE))"

book: ## [EDITION=student|instructor] [CHAPTER=04] [DRAFT=1] [ACCEPT=1] [FRESH=1] weaves the book into build/book/
	@.setup/setup.sh
	@.setup/setup.sh book
	@$(python) -m raybook_grader.book $(if $(EDITION),--edition $(EDITION)) \
	    $(if $(CHAPTER),--chapter $(CHAPTER)) $(if $(DRAFT),--draft) $(if $(ACCEPT),--accept) \
	    $(if $(FRESH),--fresh)

handout: ## [OUT=dir] [A=03] [REVEAL=01,02] writes the student edition
	@.setup/setup.sh
	@$(grader) handout "$(or $(OUT),build/handout)" $(if $(A),--assignment $(A)) \
	    $(if $(REVEAL),--reveal $(REVEAL))

grade: ## SUBMISSIONS=dir [OUT=dir] [A=01] grades a class
	@test -n "$(SUBMISSIONS)" || { echo "make grade: say SUBMISSIONS=dir" >&2; exit 2; }
	@.setup/setup.sh
	@$(MAKE) kit
	@$(grader) grade "$(SUBMISSIONS)" --out "$(or $(OUT),build/grades)" \
	    $(if $(A),--assignment $(A)) $(ARGS)

museum: ## [A=03] judges all alternatives and mistakes; which public tests catch which
	@.setup/setup.sh
	@$(MAKE) kit
	@$(grader) museum $(if $(A),--assignment $(A)) $(ARGS)

calibrate: ## [A=03] [FULL=1] judges all that is known to be right or wrong: the confusion table
	@.setup/setup.sh
	@$(MAKE) kit
	@$(grader) calibrate $(if $(A),--module $(A)) $(if $(FULL),--full) $(ARGS)

references: ## renders the statistics that are committed in grader/statistics/
	@.setup/setup.sh
	@$(MAKE) kit
	@$(grader) references

# The reference as objects, for linking with one module of a student.
kit: build/meshes/done ## what the grader links students' modules with: build/kit/
	@$(MAKE) $(jobs) OPT=release EMBREE=no objects lto= config=kit

objects: $(objects)
	@python3 grader/make_kit.py --objects $(objdir) --out build/kit --version '$(VERSION)' \
	    --cc '$(CC)' --cflags='$(filter-out -Isrc -Werror,$(cflags))' \
	    --ldflags='$(ldflags)' --ldlibs='$(ldlibs)'

# The targets below take minutes and are no part of `make test`.
variance: ## the variance of each way of sampling against a plainer one: build/variance/variance.md
	@.setup/setup.sh
	@$(python) grader/tests/renderer/variance.py $(ARGS)

mitsuba: ## [ARGS="--spp 4096"] compares our pictures with Mitsuba 3's, in a venv of its own
	@.setup/setup.sh
	@$(MAKE) -s $(program)
	@grader/tests/mitsuba/compare.sh --raybook "$(program)" $(ARGS)

bench: ## [QUICK=1] [ARGS="--only rays"] speed beside Embree and Mitsuba 3: build/bench/bench.md
	@.setup/setup.sh
	@$(MAKE) -s $(program) build/meshes/done kit
	@$(python) grader/tests/bench/bench.py $(if $(QUICK),--quick,--full) $(ARGS)

judge-table: ## [ARGS="--looks 5"] the verdict on a small bias, on mere noise, and on half-right work
	@.setup/setup.sh
	@$(MAKE) kit
	@$(python) grader/tests/judge/judge_table.py $(ARGS)
	@$(python) grader/tests/judge/partial_credit.py

class: ## [N=200] [SEED=1] [A=01,03] grades a made-up class, and compares every score with what it must be
	@.setup/setup.sh
	@$(MAKE) kit
	@$(python) grader/tests/classroom/classroom.py $(or $(N),200) --seed $(or $(SEED),1) \
	    $(if $(A),--assignment $(A)) $(ARGS)

kill-table: ## [KILLS=200] kills runs of the grader at random moments and compares what comes of it
	@.setup/setup.sh
	@$(MAKE) kit
	@$(python) grader/tests/grade/kill_table.py --kills $(or $(KILLS),200) $(ARGS)

fuzz: ## [SECONDS=600] searches for files that crash the readers of scenes, meshes and images
	@.setup/setup.sh
	@$(python) grader/tests/fuzz/run.py --seconds $(or $(SECONDS),600) $(ARGS)

hostile: ## [ARGS="--quick"] grades what attacks the grader, case by case: build/hostile/table.md
	@.setup/setup.sh
	@$(MAKE) -s $(program) kit
	@$(python) grader/tests/hostile/hostile_table.py $(ARGS)

cluster-table: ## grades a small class on Dask clusters whose workers die and join: the same grades
	@.setup/setup.sh
	@$(MAKE) kit
	@$(python) grader/tests/cluster/table.py $(ARGS)

simulate: ## [ARGS="--measure"] how 100,000 submissions scale with workers: build/simulation/
	@.setup/setup.sh
	@$(MAKE) kit
	@$(python) grader/tests/scale/simulate.py $(ARGS)

clean: ## removes what is compiled; keeps the installed environment
	@rm -rf build/obj build/bin build/test build/kit build/raybook build/out

.PHONY: help setup build render test format check-format check-python check watch hint \
    debug book handout grade museum calibrate references kit objects variance mitsuba bench \
    judge-table class fuzz kill-table hostile cluster-table simulate clean
