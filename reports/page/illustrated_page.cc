#include <reports/page/illustrated_page.h>

#include <datasets/files/output_folder.h>
#include <datasets/system/console.h>
#include <reports/page/draw_pictures.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  Illustrations illustrate(const std::filesystem::path &output, const std::vector<GnuplotPicture> &pictures,
                           const std::string &origin)
  {
    Illustrations illustrations;
    illustrations.pictures = draw_pictures(output / pictures_folder_name, pictures, origin, illustrations.warning);
    return illustrations;
  }

  void add_illustrations(HtmlPage &page, const Illustrations &illustrations)
  {
    if (!illustrations.warning.empty())
      page.add_warning(illustrations.warning);
    if (!illustrations.pictures.empty())
      page.add_heading("Pictures");
    for (const std::filesystem::path &png : illustrations.pictures)
    {
      std::string description = png.stem().string();
      std::replace(description.begin(), description.end(), '_', ' ');
      page.add_picture(png, description);
    }
  }

  void write_illustrated_page(const std::filesystem::path &output, const HtmlPage &page,
                              const Illustrations &illustrations)
  {
    write_text_atomically(output / page_name, page.text());
    if (!illustrations.warning.empty())
      remark(illustrations.warning);
  }
} // namespace swimtwin
