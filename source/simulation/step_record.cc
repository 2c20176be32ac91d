// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/simulation/step_record.h>

#include <string>

namespace corotet
{
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
  }
} // namespace corotet
