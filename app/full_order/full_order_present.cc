// The program that has the full-order model.
#include <app/full_order/full_order_build.h>

namespace swimtwin
{
  void require_full_order_model(const std::string & /*option*/, RanksAtWork /*ranks*/) {}
} // namespace swimtwin
