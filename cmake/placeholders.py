# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Makes placeholders of shared libraries that deal.II is linked with and that the program never calls (see placeholders.cmake).

    placeholders.py DEAL_II_LIBRARY PATTERN COMPILER FOLDER

For each library that DEAL_II_LIBRARY needs and whose name matches PATTERN, FOLDER gets a placeholder, a library of the same name. It
defines all symbols that deal.II and the other loaded libraries would take from the real library, and from libraries that only the
real library needs. Functions of a placeholder say their name and end the program; variables have the same size and are zero. A
library whose symbols have versions gets no placeholder.
"""

import pathlib
import re
import shutil
import subprocess
import sys

HEAD = """#include <stdio.h>
#include <stdlib.h>
static void left_out(const char *name)
{
  fprintf(stderr, "error: the library with %s is left out of this program\\n", name);
  abort();
}
"""


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout


def dynamic_symbols(file):
    """Yields (name, type, whether it is defined, size) for each symbol of the file that is not local."""
    pattern = r"^ +\d+: [0-9a-f]+ +(\S+) (\w+) +(?:GLOBAL|WEAK|UNIQUE) +\w+ +(\w+) ([^@\n]+)"
    for size, kind, section, name in re.findall(pattern, output_of("readelf", "-W", "--dyn-syms", file), re.MULTILINE):
        yield name, kind, section != "UND", int(size, 0)


class Libraries:
    """The path of each library that is loaded together with the library `first`, by name."""

    def __init__(self, first):
        self.first = first
        self.paths = dict(re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", first), re.MULTILINE))
        self.kept_needed = {}

    def needed(self, file):
        if file not in self.kept_needed:
            self.kept_needed[file] = re.findall(r"\(NEEDED\).*\[(.*)\]", output_of("readelf", "-W", "-d", file))
        return self.kept_needed[file]

    def without(self, left_out):
        """Paths of the libraries that are still loaded if the libraries named in left_out are not."""
        found, open_ones = {self.first}, [self.first]
        while open_ones:
            for name in self.needed(open_ones.pop()):
                path = self.paths.get(name)
                if path and name not in left_out and path not in found:
                    found.add(path)
                    open_ones.append(path)
        return found


def source(symbols):
    lines = [HEAD]
    for name, (kind, size) in sorted(symbols.items()):
        if kind in ("FUNC", "IFUNC"):
            lines.append(f'void {name}(void) {{ left_out("{name}"); }}')
        else:
            lines.append(f"{'_Thread_local ' if kind == 'TLS' else ''}char {name}[{max(size, 8)}] __attribute__((aligned(32)));")
    return "\n".join(lines) + "\n"


def main():
    library, pattern, compiler, folder = sys.argv[1:]
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    libraries = Libraries(library)
    left_out = [name for name in libraries.needed(library)
                if re.match(pattern, name) and name in libraries.paths
                and "Version definition" not in output_of("readelf", "-W", "-V", libraries.paths[name])]
    if not left_out:
        return
    staying = libraries.without(left_out)
    wanted, there = set(), set()
    for path in staying:
        for name, _, defined, _ in dynamic_symbols(path):
            (there if defined else wanted).add(name)
    wanted -= there
    placeholders = {name: {} for name in left_out}
    # All libraries that are no longer loaded, each with the placeholder that gets its symbols: first the libraries that are left out, with
    # their own placeholders, then those that only they needed, with the first placeholder.
    gone = [(name, libraries.paths[name]) for name in left_out]
    gone += [(left_out[0], path) for path in libraries.paths.values() if path not in staying and path not in dict(gone).values()]
    for name, path in gone:
        for symbol, kind, defined, size in dynamic_symbols(path):
            if defined and symbol in wanted:
                placeholders[name][symbol] = (kind, size)
                wanted.discard(symbol)
    for name, symbols in placeholders.items():
        file = folder / f"{name}.c"
        file.write_text(source(symbols), encoding="utf-8")
        subprocess.run([compiler, "-x", "c", "-shared", "-fPIC", "-O1", "-fno-builtin", "-w", f"-Wl,-soname,{name}", "-o", folder / name, file],
                       check=True)
        file.unlink()


main()
