// The full-order swimmer in an imagined laboratory.
#pragma once

#include <twin/lab/lab_config.h>
#include <twin/lab/laboratory_swimmer.h>
#include <twin/motion/field_signal.h>

#include <memory>

namespace swimtwin
{
  /// Of a scene and what the laboratory's file says of it; `played` must live as long. Throws InputError in a build
  /// without the full-order model.
  std::unique_ptr<LaboratorySwimmer> make_full_order_laboratory_swimmer(const Scene &scene, const LabConfig &config,
                                                                        const FieldSignal &played);
} // namespace swimtwin
