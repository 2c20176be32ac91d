// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "surface_lines.h"

namespace corotet::surface_files
{
  namespace
  {
    enum class Type
    {
      int8,
      uint8,
      int16,
      uint16,
      int32,
      uint32,
      float32,
      float64
    };

    const std::map<std::string, Type> types{{"char", Type::int8},
                                            {"int8", Type::int8},
                                            {"uchar", Type::uint8},
                                            {"uint8", Type::uint8},
                                            {"short", Type::int16},
                                            {"int16", Type::int16},
                                            {"ushort", Type::uint16},
                                            {"uint16", Type::uint16},
                                            {"int", Type::int32},
                                            {"int32", Type::int32},
                                            {"uint", Type::uint32},
                                            {"uint32", Type::uint32},
                                            {"float", Type::float32},
                                            {"float32", Type::float32},
                                            {"double", Type::float64},
                                            {"float64", Type::float64}};



    struct Property
    {
      std::string name;
      Type        type    = Type::float32;
      bool        is_list = false;
      /// The type of the length of a list.
      Type length_type = Type::uint8;
    };

    struct Element
    {
      std::string           name;
      long long             n = 0;
      std::vector<Property> properties;
    };



    /// Reads the header, and then numbers, as text or as bytes.
    class PlyReader
    {
    public:
      PlyReader(const std::string &bytes, TriangleSurface &surface)
        : bytes(bytes)
        , lines(surface.origin, bytes)
        , surface(surface)
      {}

      void
      read()
      {
        read_header();
        surface.names.emplace_back();
        position = lines.position();
        // Elements without properties have no data, however many there are.
        for (const Element &element : elements)
          for (long long i = 0; i < element.n && !element.properties.empty();
               ++i)
            read_element(element, i);
      }

    private:
      const std::string   &bytes;
      Lines                lines;
      TriangleSurface     &surface;
      std::vector<Element> elements;
      bool                 is_text    = true;
      bool                 is_swapped = false;
      // The position of the next number in the bytes, or its word in the line.
      std::size_t position = 0, word = 0;

      Type
      type_of(const std::size_t i)
      {
        const std::string name =
          i < lines.words().size() ? std::string(lines.words()[i]) : "";
        const auto found = types.find(name);
        if (found == types.end())
          lines.refuse(fmt::format("the type of a property is unknown: found "
                                   "'{}'; allowed are char, uchar, short, "
                                   "ushort, int, uint, float, double",
                                   shortened(name, 40)));
        return found->second;
      }

      void
      read_format()
      {
        const std::string format(lines.words().size() > 1 ? lines.words()[1] :
                                                            "");
        is_text = format == "ascii";
        if (!is_text && format != "binary_little_endian" &&
            format != "binary_big_endian")
          lines.refuse(fmt::format("the format is unknown: found '{}'; allowed "
                                   "are ascii, binary_little_endian, "
                                   "binary_big_endian",
                                   shortened(format, 40)));
        is_swapped = (format == "binary_big_endian") ==
                     (std::endian::native == std::endian::little);
      }

      void
      read_property()
      {
        if (elements.empty())
          lines.refuse("a property comes before the first element");
        Property property;
        property.is_list =
          lines.words().size() > 1 && lines.words()[1] == "list";
        if (property.is_list)
          property.length_type = type_of(2);
        if (property.is_list && (property.length_type == Type::float32 ||
                                 property.length_type == Type::float64))
          lines.refuse("the length of a list is a whole number");
        const std::size_t i = property.is_list ? 3 : 1;
        property.type       = type_of(i);
        if (lines.words().size() <= i + 1)
          lines.refuse("a property has no name");
        property.name = lines.words()[i + 1];
        elements.back().properties.push_back(property);
      }

      void
      read_header()
      {
        while (lines.next(0))
          {
            const std::string_view keyword = lines.words()[0];
            if (keyword == "format")
              read_format();
            else if (keyword == "element")
              {
                Element element;
                if (lines.words().size() > 1)
                  element.name = lines.words()[1];
                element.n = lines.integer(2);
                if (element.n < 0)
                  lines.refuse(fmt::format("a number of elements is negative: "
                                           "found {}",
                                           element.n));
                elements.push_back(element);
              }
            else if (keyword == "property")
              read_property();
            else if (keyword == "end_header")
              {
                check_header();
                return;
              }
            else if (keyword != "ply" && keyword != "comment" &&
                     keyword != "obj_info")
              lines.refuse(fmt::format("the keyword is unknown: found '{}'",
                                       shortened(std::string(keyword), 40)));
          }
        lines.refuse_end("end_header");
      }

      const Element *
      element(const std::string &name) const
      {
        const auto found =
          std::find_if(elements.begin(), elements.end(), [&](const Element &e) {
            return e.name == name;
          });
        return found == elements.end() ? nullptr : &*found;
      }

      static bool
      is_corner_list(const Property &property)
      {
        return property.is_list && (property.name == "vertex_indices" ||
                                    property.name == "vertex_index");
      }

      void
      check_header() const
      {
        const Element *const vertex = element("vertex");
        const Element *const face   = element("face");
        for (const std::string name : {"x", "y", "z"})
          if (vertex == nullptr || std::none_of(vertex->properties.begin(),
                                                vertex->properties.end(),
                                                [&](const Property &property) {
                                                  return !property.is_list &&
                                                         property.name == name;
                                                }))
            lines.refuse("there are no elements 'vertex' with the properties "
                         "x, y, z");
        if (face == nullptr || std::none_of(face->properties.begin(),
                                            face->properties.end(),
                                            is_corner_list))
          lines.refuse("there are no elements 'face' with a list "
                       "vertex_indices: is this a cloud of points? Needed is "
                       "a closed surface of triangles");
      }

      template <typename Number>
      double
      binary_number()
      {
        if (bytes.size() - position < sizeof(Number))
          lines.refuse_end("the last of its elements");
        char here[sizeof(Number)];
        std::memcpy(here, bytes.data() + position, sizeof(Number));
        if (is_swapped)
          std::reverse(here, here + sizeof(Number));
        position += sizeof(Number);
        Number result;
        std::memcpy(&result, here, sizeof(Number));
        return static_cast<double>(result);
      }

      double
      binary_number(const Type type)
      {
        switch (type)
          {
            case Type::int8:
              return binary_number<std::int8_t>();
            case Type::uint8:
              return binary_number<std::uint8_t>();
            case Type::int16:
              return binary_number<std::int16_t>();
            case Type::uint16:
              return binary_number<std::uint16_t>();
            case Type::int32:
              return binary_number<std::int32_t>();
            case Type::uint32:
              return binary_number<std::uint32_t>();
            case Type::float32:
              return binary_number<float>();
            default:
              return binary_number<double>();
          }
      }

      double
      number(const Type type)
      {
        return is_text ? lines.number(word++) : binary_number(type);
      }

      [[noreturn]] void
      refuse(const Element &element, const long long i, const std::string &what)
      {
        const std::string message =
          fmt::format("{} {} of {}: {}", element.name, i + 1, element.n, what);
        if (is_text)
          lines.refuse(message);
        throw InputError("", surface.origin + ": " + message);
      }

      void
      read_element(const Element &element, const long long i)
      {
        word = 0;
        if (is_text && !lines.next(0))
          lines.refuse_end(
            fmt::format("{} {} of {}", element.name, i + 1, element.n));
        dealii::Point<3>          point;
        std::vector<unsigned int> corners;
        for (const Property &property : element.properties)
          {
            const double length =
              property.is_list ? number(property.length_type) : 1;
            const bool are_corners =
              element.name == "face" && is_corner_list(property);
            if (are_corners && (length < 3 || length > 1000))
              refuse(element,
                     i,
                     fmt::format("a face has 3 to 1000 corners: found {}",
                                 length));
            if (length < 0)
              refuse(element, i, "the length of a list is negative");
            for (double k = 0; k < length; ++k)
              {
                const double value = number(property.type);
                if (are_corners)
                  corners.push_back(corner(element, i, value));
                else if (element.name == "vertex")
                  for (unsigned int d = 0; d < 3; ++d)
                    if (property.name == std::string(1, "xyz"[d]))
                      point[d] = value;
              }
          }
        if (element.name == "vertex")
          {
            if (!std::isfinite(point.norm()))
              refuse(element,
                     i,
                     fmt::format("no point: found {}, {}, {}",
                                 point[0],
                                 point[1],
                                 point[2]));
            surface.vertices.push_back(point);
            check_number_of_vertices(surface);
          }
        else if (element.name == "face")
          add_polygon(surface, corners, 0);
      }

      unsigned int
      corner(const Element &element, const long long i, const double value)
      {
        const auto n = static_cast<double>(surface.vertices.size());
        // These comparisons also refuse a value that is not a number.
        const bool is_there =
          value >= 0 && value < n && value == std::floor(value);
        if (!is_there)
          refuse(element,
                 i,
                 n == 0 ?
                   "a face before any vertices; they must come first" :
                   fmt::format("no such vertex: found {}; allowed are 0 to {}",
                               value,
                               n - 1));
        return static_cast<unsigned int>(value);
      }
    };
  } // namespace



  void
  read_ply(const std::string &bytes, TriangleSurface &surface)
  {
    PlyReader(bytes, surface).read();
  }
} // namespace corotet::surface_files
