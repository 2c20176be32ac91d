// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_surface_lines_h
#define corotet_source_mesh_surface_lines_h

#include <corotet/mesh/triangle_surface.h>

#include <string>
#include <string_view>
#include <vector>

namespace corotet::surface_files
{
  /// A whole file in memory, line by line.
  class Lines
  {
  public:
    Lines(const std::string &path, const std::string &bytes);

    /// Goes to the next line that has words; what follows a @p comment
    /// character in a line is ignored (0: there are no comments). Returns
    /// whether there is such a line.
    bool
    next(const char comment = '#');

    /// The words of the present line.
    const std::vector<std::string_view> &
    words() const
    {
      return present;
    }

    /// The text behind the first word, without blanks around it.
    std::string
    rest() const;

    /// The position of the next line [byte].
    std::size_t
    position() const
    {
      return begin_of_next;
    }

    /// Word @p i of the line as a number. Throws an InputError if it is not a
    /// number, or not finite.
    double
    number(const std::size_t i) const;

    /// Word @p i of the line as a whole number. Throws an InputError if it is
    /// not.
    long long
    integer(const std::size_t i) const;

    /// The point with the three coordinates from word @p i on.
    dealii::Point<3>
    point(const std::size_t i) const;

    /// Throws an InputError about the present line.
    [[noreturn]] void
    refuse(const std::string &message) const;

    /// Throws an InputError about a file that ends too early.
    [[noreturn]] void
    refuse_end(const std::string &what) const;

  private:
    const std::string            &path;
    const std::string            &bytes;
    std::string_view              line;
    std::size_t                   begin_of_next = 0;
    std::size_t                   line_number   = 0;
    std::vector<std::string_view> present;
  };

  void
  read_stl(const std::string &bytes, TriangleSurface &surface);

  void
  read_ply(const std::string &bytes, TriangleSurface &surface);

  void
  read_obj(const std::string &bytes, TriangleSurface &surface);

  void
  read_off(const std::string &bytes, TriangleSurface &surface);

  /// Adds the triangles of a plane polygon, which has at least three corners;
  /// their vertices are in the surface already.
  void
  add_polygon(TriangleSurface                 &surface,
              const std::vector<unsigned int> &corners,
              const unsigned int               group);

  /// Throws an InputError if the vertices of a file, and @p more, are too many
  /// for the numbers used here.
  void
  check_number_of_vertices(const TriangleSurface &surface,
                           const std::size_t      more = 0);
} // namespace corotet::surface_files

#endif
