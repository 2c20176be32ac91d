// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/simulation/step_record.h>

#include <sstream>
#include <string>

namespace corotet
{
  namespace
  {
    dealii::Tensor<1, 3>
    tensor_of(const std::vector<double> &components, const std::size_t first)
    {
      return dealii::Tensor<1, 3>({components.at(first),
                                   components.at(first + 1),
                                   components.at(first + 2)});
    }
  } // namespace

  void
  StepRecord::transfer(Archive &archive)
  {
    archive.transfer("step", step);
    archive.transfer("time", time);
    archive.transfer("dt", dt);
    archive.transfer("newton_iterations", newton_iterations);
    archive.transfer("linear_iterations", linear_iterations);
    archive.transfer("kinetic_energy", kinetic_energy);
    archive.transfer("elastic_energy", elastic_energy);
    archive.transfer("dissipated_energy", dissipated_energy);
    archive.transfer("external_work", external_work);
    archive.transfer("energy_balance", energy_balance);
    archive.transfer("max_displacement", max_displacement);
    archive.transfer("min_det_F", min_det_F);
    archive.transfer("inverted_cells", inverted_cells);
    archive.transfer("degenerate_cells", degenerate_cells);
    archive.transfer("robust_rotations", robust_rotations);
    archive.transfer("clamped_cells", clamped_cells);
    archive.transfer("parts", parts);
    archive.transfer("rejected_steps", rejected_steps);
    archive.transfer("wall_time", wall_time);
    archive.transfer("volume", volume);
    const auto transfer_vector = [&](const std::string    &name,
                                     dealii::Tensor<1, 3> &vector) {
      archive.within(name, [&] {
        for (unsigned int a = 0; a < 3; ++a)
          archive.transfer(std::to_string(a), vector[a]);
      });
    };
    transfer_vector("momentum", momentum);
    transfer_vector("angular_momentum", angular_momentum);
    transfer_vector("reaction", reaction);
    transfer_vector("internal_moment", internal_moment);
    archive.transfer("contact_energy", contact_energy);
    archive.transfer("friction_work", friction_work);
    transfer_contact_forces(archive);
    transfer_ground_forces(archive);
  }

  void
  StepRecord::transfer_contact_forces(Archive &archive)
  {
    std::vector<double> components;
    std::string         names;
    for (const auto &[name, force] : contact_forces)
      {
        names += name + ' ';
        components.insert(components.end(), force.begin_raw(), force.end_raw());
      }
    archive.transfer("obstacles", names);
    archive.transfer("contact_forces", components);
    contact_forces.clear();
    std::istringstream words(names);
    std::string        name;
    for (std::size_t i = 0; words >> name; i += 3)
      contact_forces.emplace_back(name, tensor_of(components, i));
  }

  void
  StepRecord::transfer_ground_forces(Archive &archive)
  {
    std::vector<unsigned int> boundaries;
    std::vector<double>       components;
    for (const GroundForce &ground : ground_forces)
      {
        boundaries.push_back(ground.boundary);
        for (const auto *vector : {&ground.force, &ground.moment})
          components.insert(components.end(),
                            vector->begin_raw(),
                            vector->end_raw());
      }
    archive.transfer("ground_boundaries", boundaries);
    archive.transfer("ground_forces", components);
    ground_forces.clear();
    for (std::size_t i = 0; i < boundaries.size(); ++i)
      ground_forces.push_back({boundaries[i],
                               tensor_of(components, 6 * i),
                               tensor_of(components, 6 * i + 3)});
  }
} // namespace corotet
