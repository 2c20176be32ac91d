// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_gmsh_med_file_h
#define corotet_source_gmsh_med_file_h

#include <med.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace corotet::gmsh_program
{
  /// Throws the error that refuses a MED file.
  [[noreturn]] inline void
  refuse_med(const std::string &what)
  {
    throw std::runtime_error("MED: " + what);
  }



  /// Returns a number or a status of MED's library; throws if it is negative,
  /// an error.
  template <typename Number>
  Number
  valid(const Number result, const std::string &what)
  {
    if (result < 0)
      refuse_med(what + " cannot be read; is the file damaged?");
    return result;
  }



  /// A text in a field of fixed length, whose unused rest is zero or blank.
  inline std::string
  text(const char *begin, const std::size_t length)
  {
    std::string result(begin, std::find(begin, begin + length, '\0'));
    result.erase(result.find_last_not_of(' ') + 1);
    return result;
  }



  /**
   * A MED file with one mesh, open for reading. Throws std::runtime_error if it
   * is not such a file, or if something cannot be read.
   */
  class MedFile
  {
  public:
    explicit MedFile(const std::string &path)
    {
      med_bool is_hdf = MED_FALSE, is_known = MED_FALSE;
      if (MEDfileCompatibility(path.c_str(), &is_hdf, &is_known) < 0 ||
          is_hdf == MED_FALSE)
        refuse_med("this is no file of HDF5; is it damaged?");
      if (is_known == MED_FALSE)
        refuse_med("found a file of a version that the library does not "
                   "read, or a damaged one; allowed are MED 3 and newer");
      file = valid(MEDfileOpen(path.c_str(), MED_ACC_RDONLY), "the file");
      find_mesh();
    }

    ~MedFile()
    {
      MEDfileClose(file);
    }

    MedFile(const MedFile &) = delete;
    MedFile &
    operator=(const MedFile &) = delete;


    std::vector<double>
    coordinates() const
    {
      std::vector<double> result(3 *
                                 number(MED_NODE, MED_NONE, MED_COORDINATE));
      if (result.empty())
        refuse_med("the mesh '" + mesh + "' has no nodes");
      valid(
        MEDmeshNodeCoordinateRd(
          file, mesh.c_str(), step, order, MED_FULL_INTERLACE, result.data()),
        "coordinates");
      return result;
    }


    /// The number of elements of a type.
    std::size_t
    n_elements(const med_geometry_type type) const
    {
      return number(MED_CELL, type, MED_CONNECTIVITY);
    }


    /// The nodes of all elements of a type, @p n numbers in all, counted from
    /// one.
    std::vector<med_int>
    nodes(const med_geometry_type type, const std::size_t n) const
    {
      std::vector<med_int> result(n);
      valid(MEDmeshElementConnectivityRd(file,
                                         mesh.c_str(),
                                         step,
                                         order,
                                         MED_CELL,
                                         type,
                                         MED_NODAL,
                                         MED_FULL_INTERLACE,
                                         result.data()),
            "elements");
      return result;
    }


    std::size_t
    n_polyhedra() const
    {
      // The index has the first face of each polyhedron, and the end of the
      // faces.
      const std::size_t n = number(MED_CELL, MED_POLYHEDRON, MED_INDEX_FACE);
      return n > 0 ? n - 1 : 0;
    }


    /// The family of each element of a type, or of each node; 0 if it has none.
    std::vector<med_int>
    families(const med_entity_type   entity,
             const med_geometry_type type,
             const std::size_t       n) const
    {
      std::vector<med_int> result(n, 0);
      const std::size_t    n_known = number(entity, type, MED_FAMILY_NUMBER);
      if (n_known == 0)
        return result;
      if (n_known != n)
        refuse_med("families are not known of all elements");
      valid(MEDmeshEntityFamilyNumberRd(
              file, mesh.c_str(), step, order, entity, type, result.data()),
            "families");
      return result;
    }


    /// The groups of each family.
    std::map<med_int, std::vector<std::string>>
    groups() const
    {
      std::map<med_int, std::vector<std::string>> result;
      const med_int                               n_families =
        valid(MEDnFamily(file, mesh.c_str()), "families");
      for (med_int i = 1; i <= n_families; ++i)
        {
          const med_int n_groups =
            valid(MEDnFamilyGroup(file, mesh.c_str(), i), "groups");
          std::vector<char> names(n_groups * MED_LNAME_SIZE + 1, '\0');
          char              family[MED_NAME_SIZE + 1] = "";
          med_int           id                        = 0;
          valid(MEDfamilyInfo(file, mesh.c_str(), i, family, &id, names.data()),
                "groups");
          for (med_int j = 0; j < n_groups; ++j)
            result[id].push_back(
              text(names.data() + std::size_t(j) * MED_LNAME_SIZE,
                   MED_LNAME_SIZE));
        }
      return result;
    }

  private:
    // Finds the name of the only mesh, and its first state.
    void
    find_mesh()
    {
      const med_int n_meshes = valid(MEDnMesh(file), "the list of meshes");
      if (n_meshes != 1)
        refuse_med("found " + std::to_string(n_meshes) +
                   " meshes; allowed is a file with one");
      char              name[MED_NAME_SIZE + 1]           = "";
      char              description[MED_COMMENT_SIZE + 1] = "";
      char              time_unit[MED_SNAME_SIZE + 1]     = "";
      const med_int     n_axes = valid(MEDmeshnAxis(file, 1), "the mesh");
      std::vector<char> axes(n_axes * MED_SNAME_SIZE + 1, '\0');
      std::vector<char> units(n_axes * MED_SNAME_SIZE + 1, '\0');
      med_int           space = 0, dimension = 0, n_steps = 0;
      med_mesh_type     kind{};
      med_sorting_type  sorting{};
      med_axis_type     axis{};
      valid(MEDmeshInfo(file,
                        1,
                        name,
                        &space,
                        &dimension,
                        &kind,
                        description,
                        time_unit,
                        &sorting,
                        &n_steps,
                        &axis,
                        axes.data(),
                        units.data()),
            "the mesh");
      mesh = name;
      if (space != 3 || kind != MED_UNSTRUCTURED_MESH || axis != MED_CARTESIAN)
        refuse_med("the mesh '" + mesh + "' has " + std::to_string(space) +
                   " coordinates" +
                   (kind == MED_UNSTRUCTURED_MESH ? "" : " and a structure") +
                   "; allowed are unstructured meshes with x, y, z");
      med_float time = 0;
      if (n_steps > 0)
        valid(MEDmeshComputationStepInfo(
                file, mesh.c_str(), 1, &step, &order, &time),
              "the state of the mesh");
    }


    std::size_t
    number(const med_entity_type   entity,
           const med_geometry_type type,
           const med_data_type     data) const
    {
      med_bool has_moved = MED_FALSE, is_transformed = MED_FALSE;
      return valid(MEDmeshnEntity(file,
                                  mesh.c_str(),
                                  step,
                                  order,
                                  entity,
                                  type,
                                  data,
                                  entity == MED_NODE ? MED_NO_CMODE : MED_NODAL,
                                  &has_moved,
                                  &is_transformed),
                   "the number of elements");
    }

    med_idt     file = -1;
    std::string mesh;
    med_int     step = MED_NO_DT, order = MED_NO_IT;
  };
} // namespace corotet::gmsh_program

#endif
