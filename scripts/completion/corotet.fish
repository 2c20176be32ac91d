# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
# Completion of corotet's command line for fish: put this file into ~/.config/fish/completions, or install it into
# share/fish/vendor_completions.d.

# Names of all entries, "Section/Entry = ", which the program prints.
function __corotet_entries
    corotet --print-parameters prm 2>/dev/null | awk '
      $1 == "subsection" { sub(/^ *subsection /, ""); section[++depth] = $0 }
      $1 == "end" { depth-- }
      $1 == "set" {
        sub(/^ *set /, ""); sub(/ *=.*/, "")
        path = ""
        for (i = 1; i <= depth; ++i) path = path section[i] "/"
        print path $0 " = "
      }'
end

set --local run "not __fish_seen_subcommand_from mesh"
set --local mesh "__fish_seen_subcommand_from mesh"

complete -c corotet -n __fish_use_subcommand -a mesh -d "Read or make a mesh, check it, and describe it"
complete -c corotet -s h -l help -d "Print help and exit"
complete -c corotet -n $run -l version -d "Print versions and exit"
complete -c corotet -n $run -l set -x -a "(__corotet_entries)" -d "Override an entry"
complete -c corotet -n $run -l output -x -a "(__fish_complete_directories)" -d "Override the output directory"
complete -c corotet -n $run -l validate -d "Read and check everything, run nothing"
complete -c corotet -n $run -l print-parameters -x -a "prm json markdown schema" -d "List every entry"
complete -c corotet -n $run -l restart -d "Go on from the newest good checkpoint"
complete -c corotet -n $run -l report -d "Also write the page of the run"
complete -c corotet -n $run -l list -d "List ready cases, laws, forces, integrators, preconditioners, mesh formats"
complete -c corotet -n $run -l quiet -d "Show nothing but errors"
complete -c corotet -n $mesh -l size -x -d "Target length of edges in cells made for a geometry"
complete -c corotet -n $mesh -l degree -x -a "1 2 3" -d "Polynomial degree of the cells made for a geometry"
complete -c corotet -n $mesh -l feature-angle -x -d "Angle between normals above which a surface of triangles has an edge, in degrees"
complete -c corotet -n $mesh -l out -r -d "Write the mesh to this .msh or .h5 file"
