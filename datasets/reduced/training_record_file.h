// What was measured when a reduced model was trained, as the group /training of its file.
#pragma once

#include <datasets/reduced/reduced_model.h>

namespace swimtwin
{
  class Hdf5Reader;
  class Hdf5Writer;

  void           write_training_record(Hdf5Writer &writer, const TrainingRecord &record);
  TrainingRecord read_training_record(const Hdf5Reader &reader);
} // namespace swimtwin
