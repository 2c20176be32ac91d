# Shortcuts for people; CMake does the work, and scripts/toolchain finds or makes what it needs. Try: make help

TOOLCHAIN := scripts/toolchain
# The case that `make run` runs.
PRM ?= parameters/cantilever.prm
# Further arguments of the program, e.g. ARGUMENTS='--set "Time integration/End time = 1"'.
ARGUMENTS ?=
# The CMake presets that `make test` builds and tests.
PRESETS ?= release debug
# If QUICK is not empty, `make bench` measures small cases only, in eight minutes instead of half an hour.
QUICK ?=
# With GALLERY=no, `make docs` leaves out the gallery, whose cases take most of its time.
GALLERY ?= yes

# File names may have spaces, so recipes read the name of the case from their environment.
export PRM
# The folder where results of the case are by default. The page of an earlier run in it is removed, as it must not be taken for that of the new run.
SET_OUTPUT = name=$${PRM\#\#*/}; output=output/$${name%.*}

.PHONY: help run report test verify bench docs format check clean

help:
	@echo 'make run [PRM=parameters/x.prm]  build the program and run a case; its results replace those of the last run'
	@echo 'make report [PRM=...]            the same, and the page of the run: one file, for any browser'
	@echo 'make test                        build and test: Release and Debug'
	@echo 'make verify                      compare cases with known answers; status 1 if one is off'
	@echo 'make bench [QUICK=1]             measure; status 1 if a required ratio is not reached'
	@echo 'make docs [GALLERY=no]           the documentation as a site with search: build/docs/index.html'
	@echo 'make format                      format the C++ files'
	@echo 'make check                       check formatting, layering, the lines of the documentation, and what has changed by clang-tidy'
	@echo 'make clean                       remove what was built (not results)'

run:
	@$(TOOLCHAIN) sh -ec 'test -f build/release/build.ninja || cmake --preset release; \
	  cmake --build --preset release --target corotet'
	@$(SET_OUTPUT); rm -f "$$output/report.html"
	@$(TOOLCHAIN) build/release/corotet "$$PRM" --set "Output/Overwrite = true" $(ARGUMENTS)

# The page is written even if the computation failed or was stopped.
report:
	@$(TOOLCHAIN) sh -ec 'test -f build/release/build.ninja || cmake --preset release; \
	  cmake --build --preset release --target corotet'
	@$(SET_OUTPUT); rm -f "$$output/report.html"
	@$(SET_OUTPUT); status=0; \
	  $(TOOLCHAIN) build/release/corotet "$$PRM" --output "$$output" --set "Output/Overwrite = true" $(ARGUMENTS) || status=$$?; \
	  case $$status in 0 | 2 | 4) $(TOOLCHAIN) scripts/report "$$output" || exit ;; esac; \
	  exit $$status

test:
	@for preset in $(PRESETS); do \
	  $(TOOLCHAIN) sh -ec 'cmake --preset $$0; cmake --build --preset $$0; ctest --preset $$0' $$preset || exit 1; \
	done

verify:
	@$(TOOLCHAIN) sh -ec 'test -f build/release/build.ninja || cmake --preset release; \
	  cmake --build --preset release --target corotet'
	@$(TOOLCHAIN) scripts/verify

bench:
	@$(TOOLCHAIN) sh -ec 'cmake -G Ninja -B build/bench -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCOROTET_TESTS=OFF -DCOROTET_BENCHMARKS=ON; \
	  cmake --build build/bench --target corotet bench_machine bench_kernels bench_case'
	@status=0; \
	for script in run_benchmarks.py 'end_to_end.py --program build/bench/corotet' 'hard_bodies.py --program build/bench/corotet'; do \
	  $(TOOLCHAIN) benchmarks/$$script $(if $(QUICK),--quick) || status=1; \
	done; \
	exit $$status

docs:
	@$(TOOLCHAIN) sh -ec 'test -f build/release/build.ninja || cmake --preset release; \
	  cmake --build --preset release --target corotet'
	@$(TOOLCHAIN) scripts/docs $(if $(filter no,$(GALLERY)),--no-gallery)

format:
	@$(TOOLCHAIN) scripts/check_format --fix

check:
	@$(TOOLCHAIN) scripts/check_format
	@$(TOOLCHAIN) scripts/check_layers
	@$(TOOLCHAIN) scripts/check_docs
	@$(TOOLCHAIN) scripts/check_tidy

clean:
	rm -rf build
