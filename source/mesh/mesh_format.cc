// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>

namespace corotet
{
  namespace
  {
    // What formats begin with is within these bytes.
    constexpr std::size_t n_first_bytes = 4096;



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



    // Lines of 80 columns; column 73 has the letter of the section, then the
    // number of the line follows.
    bool
    begins_like_iges(const std::string &bytes)
    {
      return bytes.size() > 80 && bytes[72] == 'S' &&
             bytes.substr(73, 7).find_first_not_of(" 0") == 6 &&
             bytes[79] == '1';
    }



    // The first line that is no comment has a keyword.
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



    std::optional<MeshFormat>
    format_by_content(const std::string &bytes)
    {
      const auto has = [&](const std::string &text, const std::size_t most) {
        return bytes.substr(0, most).find(text) != std::string::npos;
      };
      const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
      if (begin != std::string::npos &&
          bytes.compare(begin, 11, "$MeshFormat") == 0)
        return MeshFormat::msh;
      if (has("ISO-10303-21", 200))
        return MeshFormat::step;
      if (has("DBRep_DrawableShape", 200) || has("CASCADE Topology", 200))
        return MeshFormat::brep;
      if (begins_like_iges(bytes))
        return MeshFormat::iges;
      if (begins_like_abaqus(bytes))
        return MeshFormat::abaqus;
      return {};
    }
  } // namespace



  const std::vector<MeshFormatDescription> &
  mesh_formats()
  {
    static const std::vector<MeshFormatDescription> formats{
      {MeshFormat::msh, "msh", ".msh", "mesh of gmsh, 2.2, 4.0 or 4.1", false},
      {MeshFormat::geo, "geo", ".geo", "geometry of gmsh", true},
      {MeshFormat::step, "step", ".stp, .step", "geometry, STEP", true},
      {MeshFormat::iges, "iges", ".igs, .iges", "geometry, IGES", true},
      {MeshFormat::brep, "brep", ".brep", "geometry of OpenCASCADE", true},
      {MeshFormat::abaqus,
       "abaqus",
       ".inp",
       "mesh of Abaqus or CalculiX",
       false}};
    return formats;
  }



  const MeshFormatDescription &
  mesh_format(const std::string &path, const std::string &entry)
  {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char &c : extension)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::optional<MeshFormat> by_content =
      extension == ".geo" ? MeshFormat::geo :
                            format_by_content(first_bytes(path));
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
} // namespace corotet
