// The page of a twin's folder.
#pragma once

#include <reports/page/illustrated_page.h>
#include <reports/twin/twin_record.h>

namespace swimtwin
{
  HtmlPage twin_page(const TwinRecord &record, const Illustrations &illustrations);
} // namespace swimtwin
