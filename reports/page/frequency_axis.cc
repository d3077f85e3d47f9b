#include <reports/page/frequency_axis.h>

namespace swimtwin
{
  void FrequencyAxis::set_in(GnuplotPicture &picture) const
  {
    const double room        = highest_Hz > lowest_Hz ? 0.04 * (highest_Hz - lowest_Hz) : 0.5; // a point needs some too
    const bool   logarithmic = lowest_Hz > 0. && highest_Hz > logarithmic_above * lowest_Hz;
    picture.set_flag("logarithmic", logarithmic);
    picture.set("f_min", logarithmic ? lowest_Hz / margin : lowest_Hz - room);
    picture.set("f_max", logarithmic ? highest_Hz * margin : highest_Hz + room);
  }
} // namespace swimtwin
