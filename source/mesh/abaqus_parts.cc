// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The parts and instances of files of Abaqus.

#include <corotet/base/text.h>
#include <corotet/mesh/curved_cells.h>

#include <deal.II/physics/transformations.h>

#include <fmt/format.h>

#include "abaqus_reader.h"

namespace corotet::abaqus
{
  using dealii::Point;
  using dealii::Tensor;

  void
  Reader::begin_part()
  {
    const std::string name = keyword.needed("NAME");
    if (part != nullptr)
      keyword.place.refuse("found *PART inside of a part that begins in "
                           "line " +
                           std::to_string(part->place.line));
    const auto [own, is_new] = parts.try_emplace(upper_case(name));
    if (!is_new)
      keyword.place.refuse("found a second part '" + shortened(name) +
                           "'; the first one begins in line " +
                           std::to_string(own->second.place.line));
    part        = &own->second;
    part->place = keyword.place;
  }



  void
  Reader::end_part()
  {
    if (part == nullptr)
      keyword.place.refuse("found *END PART without *PART");
    part = nullptr;
  }



  void
  Reader::begin_instance()
  {
    if (part != nullptr || instance)
      keyword.place.refuse("found *INSTANCE inside of a part or of "
                           "another instance");
    const std::string name  = keyword.needed("NAME");
    const auto        found = parts.find(upper_case(keyword.needed("PART")));
    if (found == parts.end())
      keyword.place.refuse("there is no part '" +
                           shortened(keyword.value("PART")) +
                           "' before this line");
    for (const Scope &scope : scopes)
      if (upper_case(scope.name) == upper_case(name))
        keyword.place.refuse("found a second instance with the name '" +
                             shortened(name) + "'");
    instance.emplace();
    instance->place = keyword.place;
    instance->part  = &found->second;
    instance->name  = name;
  }



  void
  Reader::add_motion(const std::vector<std::string> &words, const Place &place)
  {
    const std::size_t needed = instance->motion.empty() ? 3 : 7;
    if (words.size() != needed || instance->motion.size() > 1)
      place.refuse(fmt::format(
        "the place of an instance is a shift (3 numbers) and a turn (two "
        "points and an angle, 7 numbers): found {} numbers",
        words.size()));
    std::vector<double> &values = instance->motion.emplace_back();
    for (const std::string &word : words)
      values.push_back(number(word, place));
  }



  void
  Reader::end_instance()
  {
    if (!instance)
      keyword.place.refuse("found *END INSTANCE without *INSTANCE");
    instance.reset();
  }



  void
  Reader::place_instance()
  {
    Tensor<1, 3> shift;
    Tensor<2, 3> turn;
    Point<3>     centre;
    for (unsigned int d = 0; d < 3; ++d)
      turn[d][d] = 1;
    const auto &motion = instance->motion;
    if (!motion.empty())
      for (unsigned int d = 0; d < 3; ++d)
        shift[d] = motion[0][d];
    if (motion.size() > 1)
      {
        for (unsigned int d = 0; d < 3; ++d)
          centre[d] = motion[1][d];
        Tensor<1, 3> axis;
        for (unsigned int d = 0; d < 3; ++d)
          axis[d] = motion[1][3 + d] - motion[1][d];
        if (axis.norm() == 0)
          instance->place.refuse("the axis of the turn has no length");
        turn = dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
          axis / axis.norm(), motion[1][6] * dealii::numbers::PI / 180);
      }
    const Model &part = instance->part->model;
    spend(part.nodes.size() + part.element_nodes.size(), instance->place);
    std::vector<Point<3>> places = part.nodes;
    // This must happen now, as the digits of moved nodes tell nothing about
    // those of the file.
    if (const std::string remark =
          straighten_written_cells(places, part.quadratic_tetrahedra(), 2);
        !remark.empty())
      remarks.push_back("instance '" + shortened(instance->name) +
                        "': " + remark);
    if (!motion.empty())
      for (Point<3> &x : places)
        x = centre + turn * (x + shift - centre);
    Scope copy = model.add_copy(part, instance->part->scope, places);
    copy.name  = instance->name;
    scopes.push_back(std::move(copy));
    instance->is_placed = true;
  }
} // namespace corotet::abaqus
