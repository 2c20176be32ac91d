// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh_format.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

namespace corotet
{
  namespace
  {
    // The number of bytes in which the beginning of all formats is recognized.
    constexpr std::size_t n_first_bytes = 4096;

    constexpr const char *hdf5_signature = "\x89HDF\r\n\x1a\n";



    std::string
    first_bytes(const std::string &path)
    {
      std::ifstream file(path, std::ios::binary);
      std::string   bytes(n_first_bytes, '\0');
      if (!file)
        throw MachineError(path + ": cannot be read (permission?)");
      skip_byte_order_mark(file);
      file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      bytes.resize(file.gcount());
      return bytes;
    }



    // Whether lines have 80 columns, with the letter of the section in column
    // 73 and then the number of the line.
    bool
    begins_like_iges(const std::string &bytes)
    {
      return bytes.size() > 80 && bytes[72] == 'S' &&
             bytes.substr(73, 7).find_first_not_of(" 0") == 6 &&
             bytes[79] == '1';
    }



    // Whether the first line without a comment has a keyword.
    bool
    begins_like_abaqus(const std::string &bytes)
    {
      for (std::size_t begin = 0; begin < bytes.size();)
        {
          const std::size_t end =
            std::min(bytes.find('\n', begin), bytes.size());
          const std::size_t i = bytes.find_first_not_of(" \t\r", begin);
          if (i < end && bytes.compare(i, 2, "**") != 0)
            return bytes[i] == '*' && i + 1 < end &&
                   (std::isalpha(static_cast<unsigned char>(bytes[i + 1])) !=
                      0 ||
                    bytes[i + 1] == ' ');
          begin = end + 1;
        }
      return false;
    }



    // The first word of a line, in upper case; characters that end a word in
    // some formats count as blanks.
    std::string
    first_word(const std::string &line)
    {
      const std::size_t i = line.find_first_not_of(" \t\r");
      if (i == std::string::npos)
        return "";
      return upper_case(
        line.substr(i, line.find_first_of(" \t\r,*='\"", i) - i));
    }



    // Whether the first line without a comment is a statement of the executive
    // or of the case control, or a card of the bulk data.
    bool
    begins_like_nastran(const std::string &bytes)
    {
      std::istringstream lines(bytes);
      for (std::string line; std::getline(lines, line);)
        {
          const std::string word = first_word(line);
          if (word.empty() || word[0] == '$')
            continue;
          const std::vector<std::string> words{"NASTRAN",
                                               "ID",
                                               "SOL",
                                               "CEND",
                                               "BEGIN",
                                               "ECHO",
                                               "TITLE",
                                               "SUBCASE",
                                               "GRID",
                                               "PARAM",
                                               "CORD2R",
                                               "CTETRA",
                                               "MAT1",
                                               "PSOLID",
                                               "INIT",
                                               "ASSIGN"};
          return std::find(words.begin(), words.end(), word) != words.end();
        }
      return false;
    }



    // Whether a dataset begins: a line of -1, and a line with its number.
    bool
    begins_like_unv(const std::string &bytes)
    {
      std::istringstream words(bytes);
      std::string        first;
      int                number = 0;
      return words >> first >> number && first == "-1" && number > 0;
    }



    // Whether the size fits a binary STL file, which may begin with anything: a
    // header of 80 bytes, the number of triangles, 50 bytes for each.
    bool
    has_size_of_stl(const std::string &path, const std::string &bytes)
    {
      std::uint32_t n = 0;
      if (bytes.size() < 84)
        return false;
      std::memcpy(&n, bytes.data() + 80, sizeof(n));
      return std::filesystem::file_size(path) == 84 + 50 * std::uint64_t(n);
    }



    // Whether the first line without a comment is a statement of OBJ.
    bool
    begins_like_obj(const std::string &bytes)
    {
      std::istringstream lines(bytes);
      for (std::string line; std::getline(lines, line);)
        {
          std::istringstream words(line);
          std::string        word;
          double             x = 0;
          if (!(words >> word) || word[0] == '#')
            continue;
          return word == "mtllib" || word == "o" || word == "g" ||
                 (word == "v" && words >> x >> x >> x);
        }
      return false;
    }



    std::optional<MeshFormat>
    format_by_content(const std::string &bytes)
    {
      const auto has = [&](const std::string &text, const std::size_t most) {
        return bytes.substr(0, most).find(text) != std::string::npos;
      };
      const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
      if (begin != std::string::npos &&
          (bytes.compare(begin, 11, "$MeshFormat") == 0 ||
           bytes.compare(begin, 9, "$Comments") == 0))
        return MeshFormat::msh;
      const std::string first =
        begin == std::string::npos ?
          "" :
          first_word(bytes.substr(begin, bytes.find('\n', begin) - begin));
      if (first == "SOLID" && has("facet", n_first_bytes))
        return MeshFormat::stl;
      if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n"))
        return MeshFormat::ply;
      if (first == "OFF" || first == "COFF" || first == "NOFF")
        return MeshFormat::off;
      if (has("ISO-10303-21", 200))
        return MeshFormat::step;
      if (has("DBRep_DrawableShape", 200) || has("CASCADE Topology", 200))
        return MeshFormat::brep;
      if (begins_like_iges(bytes))
        return MeshFormat::iges;
      if (begins_like_abaqus(bytes))
        return MeshFormat::abaqus;
      if (has("# vtk DataFile", 100) || has("<VTKFile", n_first_bytes))
        return MeshFormat::vtk;
      if (has("MeshVersionFormatted", 2000))
        return MeshFormat::medit;
      if (begins_like_unv(bytes))
        return MeshFormat::unv;
      if (begins_like_nastran(bytes))
        return MeshFormat::nastran;
      if (begins_like_obj(bytes))
        return MeshFormat::obj;
      // MED files are HDF5 files with MED's groups.
      if (bytes.starts_with(hdf5_signature) &&
          has("INFOS_GENERALES", n_first_bytes))
        return MeshFormat::med;
      return {};
    }



    // Refuses incomplete BREP files, with which OpenCASCADE may never end.
    // Shapes come last, each with an asterisk at its end, then the number and
    // the place of the whole: "+1 0".
    void
    check_brep(const std::string &path)
    {
      std::ifstream file(path);
      bool          has_shapes = false;
      std::string   last, before_last;
      for (std::string line; std::getline(file, line);)
        {
          has_shapes = has_shapes || line.starts_with("TShapes ");
          while (!line.empty() &&
                 std::isspace(static_cast<unsigned char>(line.back())))
            line.pop_back();
          if (!line.empty())
            {
              before_last = std::move(last);
              last        = std::move(line);
            }
        }
      check_read_to_end(file, path);
      // Matching longer lines could fill the stack.
      constexpr std::size_t   most = 100;
      static const std::regex whole("[+-]\\d+ \\d+");
      if (!has_shapes || last.size() > most || !before_last.ends_with('*') ||
          !std::regex_match(last, whole))
        throw InputError("",
                         path + ": the file does not end with a shape behind "
                                "those of TShapes: is the rest missing?");
    }
  } // namespace



  const std::vector<MeshFormatDescription> &
  mesh_formats()
  {
    static const std::vector<MeshFormatDescription> formats{
      {MeshFormat::msh, "msh", ".msh", "mesh of gmsh, 2.2, 4.0 or 4.1", false},
      {MeshFormat::geo, "geo", ".geo", "geometry of gmsh", true},
      {MeshFormat::step, "step", ".step, .stp", "geometry, STEP", true},
      {MeshFormat::iges, "iges", ".iges, .igs", "geometry, IGES", true},
      {MeshFormat::brep, "brep", ".brep", "geometry of OpenCASCADE", true},
      {MeshFormat::stl, "stl", ".stl", "closed surface, STL", true, true},
      {MeshFormat::ply, "ply", ".ply", "closed surface, PLY", true, true},
      {MeshFormat::obj, "obj", ".obj", "closed surface, OBJ", true, true},
      {MeshFormat::off, "off", ".off", "closed surface, OFF", true, true},
      {MeshFormat::abaqus,
       "abaqus",
       ".inp",
       "mesh of Abaqus or CalculiX",
       false},
      {MeshFormat::nastran, "nastran", ".bdf, .nas", "mesh of Nastran", false},
      {MeshFormat::unv, "unv", ".unv", "mesh of I-deas, Salome", false},
      {MeshFormat::vtk, "vtk", ".vtk, .vtu", "mesh of VTK", false},
      {MeshFormat::medit, "medit", ".mesh", "mesh of Medit, ASCII", false},
      {MeshFormat::cgns, "cgns", ".cgns", "mesh in CGNS", false},
      {MeshFormat::med,
       "med",
       ".med, .rmed",
       "mesh of Salome and code_aster, MED",
       false},
      {MeshFormat::corotet, "corotet", ".h5", "mesh of corotet mesh", false}};
    return formats;
  }



  const MeshFormatDescription &
  mesh_format(const std::string &path, const std::string &entry)
  {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char &c : extension)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string         bytes = first_bytes(path);
    std::optional<MeshFormat> by_content;
    if (extension == ".geo")
      by_content = MeshFormat::geo;
    else if (has_size_of_stl(path, bytes))
      by_content = MeshFormat::stl;
    else if (bytes.starts_with(hdf5_signature) && is_hdf5_mesh(path))
      by_content = MeshFormat::corotet;
    else
      by_content = format_by_content(bytes);
    std::vector<std::string> allowed;
    for (const MeshFormatDescription &format : mesh_formats())
      {
        const std::string extensions = ", " + format.extensions + ",";
        if (by_content ?
              *by_content == format.format :
              extensions.find(" " + extension + ",") != std::string::npos)
          return format;
        allowed.push_back(format.extensions);
      }
    throw InputError(entry,
                     "the kind of mesh file is unknown: found '" +
                       shortened(path) + "'; allowed are " + join(allowed));
  }



  void
  check_end(const std::string &path, const MeshFormat format)
  {
    const std::map<MeshFormat, std::string> words{{MeshFormat::nastran,
                                                   "ENDDATA"},
                                                  {MeshFormat::unv, "-1"},
                                                  {MeshFormat::medit, "END"}};
    const auto                              wanted = words.find(format);
    if (format == MeshFormat::brep)
      check_brep(path);
    if (wanted == words.end())
      return;
    std::ifstream file(path);
    std::string   last;
    std::size_t   number = 0;
    for (std::string line; std::getline(file, line);)
      {
        ++number;
        std::string word = first_word(line);
        // Comments may follow the end.
        if (format == MeshFormat::medit && word.starts_with('#'))
          word.clear();
        if (format == MeshFormat::nastran && word == "INCLUDE")
          throw InputError("",
                           fmt::format("{}:{}: other files are not read: found "
                                       "INCLUDE; allowed is one file with the "
                                       "whole mesh",
                                       path,
                                       number));
        if (word == wanted->second)
          last = word;
        // Nastran reads nothing behind ENDDATA.
        else if (!word.empty() && format != MeshFormat::nastran)
          last.clear();
      }
    check_read_to_end(file, path);
    if (last.empty())
      throw InputError("",
                       fmt::format("{}: the file does not end with {}: is the "
                                   "rest missing?",
                                   path,
                                   wanted->second));
  }
} // namespace corotet
