#include <app/full_order/full_order_build.h>

namespace swimtwin
{
  void require_full_order_model(const std::string & /*option*/) {}
} // namespace swimtwin
