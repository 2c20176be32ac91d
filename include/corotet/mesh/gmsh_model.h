// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_model_h
#define corotet_mesh_gmsh_model_h

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace corotet
{
  /// A request to gmsh to read or mesh a file.
  struct GmshRequest
  {
    std::string path;
    /// The format by its name in mesh_formats(), or "surface": closed surfaces
    /// of triangles in a file of gmsh, one entity each, in the physical group
    /// of the body that they enclose.
    std::string format;
    /// The ending of the file's name by which gmsh recognizes the format; empty
    /// if it recognizes it by the content.
    std::string extension;
    /// Whether the file has a geometry, for which cells are made; otherwise it
    /// has a mesh.
    bool is_geometry = false;
    /// The length of edges; 0 leaves it to the file.
    double element_size = 0;
    /// The angle between the normals of triangles above which the surface has
    /// an edge [degree].
    double       feature_angle = 40;
    unsigned int degree        = 1;
    unsigned int n_refinements = 0;
    /// The largest number of cells before the refinements; with more cells, no
    /// refinements are made.
    double max_n_cells = 0;
    /// The time limit of gmsh [s], and the parameter that sets it.
    double      time_limit = 0;
    std::string time_limit_entry;
  };

  /**
   * The model that gmsh has read or made of a file, in gmsh's own terms: the
   * result that the program corotet-gmsh hands to its caller.
   */
  struct GmshModel
  {
    /// A physical group of volumes (3), surfaces (2), curves (1) or points (0),
    /// and the geometric entities that belong to it.
    struct Group
    {
      int              dimension = 0;
      int              id        = 0;
      std::string      name;
      std::vector<int> entities;
    };

    /// A type of elements that a model's volumes have.
    struct ElementType
    {
      int           type = 0;
      std::string   name;
      std::uint64_t n_elements = 0;
      /// The reference coordinates of the nodes, one point after another.
      std::vector<double> nodes;
    };

    /// Elements of one type in one geometric entity: the tags of their nodes,
    /// one element after another.
    struct Elements
    {
      int                        entity = 0;
      int                        type   = 0;
      std::vector<std::uint64_t> nodes;
    };

    /// The reason why there is no model; empty if there is one.
    std::string error;

    std::vector<Group>       groups;
    std::vector<ElementType> volume_types;
    std::vector<Elements>    volumes;
    std::vector<Elements>    surfaces;
    /// Surfaces of volumes that are curved according to the geometry: its
    /// normals at the mesh's nodes differ by more than 1e-3.
    std::vector<int> curved_surfaces;

    std::vector<std::uint64_t> node_tags;
    /// The coordinates x, y, z of each node.
    std::vector<double> coordinates;

    /// Elements of curves and points that belong to a group.
    std::vector<Elements> curves;
    std::vector<Elements> points;

    /// The only partition that has cells here, if the mesh has others; else 0.
    int only_partition = 0;

    /// Whether refining would make more cells than are allowed: then only
    /// volume_types is set.
    bool is_too_large = false;

    /// Remarks: how surfaces were sewn to solids, and how the cells differ from
    /// the request; empty if there are none.
    std::string remark;
  };



  /// Makes @p bytes transfer all of @p model; the same function writes and
  /// reads.
  template <typename Bytes>
  void
  transfer(Bytes &bytes, GmshModel &model)
  {
    bytes.transfer(model.error);
    bytes.transfer_all(model.groups, [&](GmshModel::Group &group) {
      bytes.transfer(group.dimension);
      bytes.transfer(group.id);
      bytes.transfer(group.name);
      bytes.transfer(group.entities);
    });
    bytes.transfer_all(model.volume_types, [&](GmshModel::ElementType &type) {
      bytes.transfer(type.type);
      bytes.transfer(type.name);
      bytes.transfer(type.n_elements);
      bytes.transfer(type.nodes);
    });
    const auto transfer_elements = [&](std::vector<GmshModel::Elements> &all) {
      bytes.transfer_all(all, [&](GmshModel::Elements &elements) {
        bytes.transfer(elements.entity);
        bytes.transfer(elements.type);
        bytes.transfer(elements.nodes);
      });
    };
    transfer_elements(model.volumes);
    transfer_elements(model.surfaces);
    bytes.transfer(model.curved_surfaces);
    bytes.transfer(model.node_tags);
    bytes.transfer(model.coordinates);
    bytes.transfer(model.is_too_large);
    transfer_elements(model.curves);
    transfer_elements(model.points);
    bytes.transfer(model.only_partition);
    bytes.transfer(model.remark);
  }



  /// Passes the transferred data to @p write, piece by piece.
  class BytesWriter
  {
  public:
    using Write = std::function<void(std::string_view)>;

    explicit BytesWriter(Write write)
      : write(std::move(write))
    {}

    template <typename Number>
      requires std::is_arithmetic_v<Number>
    void
    transfer(Number &number)
    {
      write({reinterpret_cast<const char *>(&number), sizeof(number)});
    }

    /// Transfers a text or numbers.
    template <typename List>
      requires(!std::is_arithmetic_v<List>)
    void
    transfer(List &list)
    {
      std::uint64_t size = list.size();
      transfer(size);
      write({reinterpret_cast<const char *>(list.data()),
             size * sizeof(typename List::value_type)});
    }

    template <typename Part, typename Action>
    void
    transfer_all(std::vector<Part> &parts, const Action &action)
    {
      std::uint64_t size = parts.size();
      transfer(size);
      for (Part &part : parts)
        action(part);
    }

  private:
    const Write write;
  };



  /// Takes the transferred data from @p bytes, which must outlive this object.
  /// Throws std::out_of_range if they end too early.
  class BytesReader
  {
  public:
    explicit BytesReader(const std::string_view bytes)
      : rest(bytes)
    {}

    template <typename Number>
      requires std::is_arithmetic_v<Number>
    void
    transfer(Number &number)
    {
      copy(&number, 1);
    }

    template <typename List>
      requires(!std::is_arithmetic_v<List>)
    void
    transfer(List &list)
    {
      list.resize(size(sizeof(typename List::value_type)));
      copy(list.data(), list.size());
    }

    template <typename Part, typename Action>
    void
    transfer_all(std::vector<Part> &parts, const Action &action)
    {
      // Each part has at least two numbers and the length of a list.
      parts.resize(size(2 * sizeof(int) + sizeof(std::uint64_t)));
      for (Part &part : parts)
        action(part);
    }

    bool
    is_at_end() const
    {
      return rest.empty();
    }

  private:
    // Reads the length of a list whose parts take @p part_size bytes or more.
    std::uint64_t
    size(const std::size_t part_size)
    {
      std::uint64_t result = 0;
      transfer(result);
      if (result > rest.size() / part_size)
        throw std::out_of_range("a list is longer than all that is left");
      return result;
    }

    template <typename Number>
    void
    copy(Number *numbers, const std::size_t n)
    {
      if (rest.size() / sizeof(Number) < n)
        throw std::out_of_range("the bytes end too early");
      rest.copy(reinterpret_cast<char *>(numbers), n * sizeof(Number));
      rest.remove_prefix(n * sizeof(Number));
    }

    std::string_view rest;
  };
} // namespace corotet

#endif
