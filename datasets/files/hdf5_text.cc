#include <datasets/files/hdf5_text.h>

#include <hdf5.h>

namespace swimtwin
{
  Hdf5Handle make_text_type(const std::size_t size)
  {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), size);
    H5Tset_cset(type.id(), H5T_CSET_UTF8);
    H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
    return type;
  }

  std::string padded(const std::string &text)
  {
    return text.empty() ? std::string(1, '\0') : text;
  }

  bool write_text_attribute(const std::int64_t object, const std::string &name, const std::string &text)
  {
    const std::string stored = padded(text);
    const Hdf5Handle  type   = make_text_type(stored.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle  attribute(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                H5Aclose);
    return attribute.id() >= 0 && H5Awrite(attribute.id(), type.id(), stored.data()) >= 0;
  }
} // namespace swimtwin
