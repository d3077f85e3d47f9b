#include <tests/fuzz/hdf5_mutation.h>

#include <datasets/files/hdf5_file.h>

#include <hdf5.h>

#include <array>
#include <limits>
#include <stdexcept>

namespace swimtwin
{
  namespace
  {
    std::int64_t valid(const std::int64_t id)
    {
      if (id < 0)
        throw std::logic_error("HDF5 cannot make a mutant");
      return id;
    }

    std::vector<std::string> objects_in(const hid_t file)
    {
      std::vector<std::string> names;
      H5Ovisit2(
          file, H5_INDEX_NAME, H5_ITER_INC,
          [](hid_t, const char *name, const H5O_info_t *, void *list) -> herr_t {
            static_cast<std::vector<std::string> *>(list)->emplace_back(name);
            return 0;
          },
          &names, H5O_INFO_BASIC);
      return names;
    }

    std::vector<std::string> attributes_of(const hid_t object)
    {
      std::vector<std::string> names;
      hsize_t                  begin = 0;
      H5Aiterate2(
          object, H5_INDEX_NAME, H5_ITER_INC, &begin,
          [](hid_t, const char *name, const H5A_info_t *, void *list) -> herr_t {
            static_cast<std::vector<std::string> *>(list)->emplace_back(name);
            return 0;
          },
          &names);
      return names;
    }

    /// An array of random shape: as before, longer, shorter, turned, of another number of dimensions, empty, none.
    Hdf5Handle random_space(std::vector<hsize_t> sizes, RandomNumbers &random)
    {
      switch (pick(random, 8))
      {
      case 0:
        return {valid(H5Screate(H5S_NULL)), H5Sclose};
      case 1:
        return {valid(H5Screate(H5S_SCALAR)), H5Sclose};
      case 2:
        sizes.push_back(1 + pick(random, 3));
        break;
      case 3:
        sizes.resize(1, 3);
        break;
      case 4:
        std::reverse(sizes.begin(), sizes.end());
        break;
      default:
        if (!sizes.empty())
          pick_from(random, sizes) += pick(random, 5);
        if (!sizes.empty())
          pick_from(random, sizes) /= 1 + pick(random, 2);
      }
      for (hsize_t &size : sizes)
        size = std::min<hsize_t>(size, 2000);
      return {valid(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr)), H5Sclose};
    }

    /// In memory: numbers of one kind, or a text.
    Hdf5Handle random_type(const hid_t before, RandomNumbers &random)
    {
      static const std::array<hid_t, 5> types = {H5T_NATIVE_INT, H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_INT64,
                                                 H5T_NATIVE_UINT8};
      if (pick(random, 2) == 0)
        return {valid(H5Tcopy(before)), H5Tclose};
      if (pick(random, 4) > 0)
        return {valid(H5Tcopy(pick_from(random, types))), H5Tclose};
      Hdf5Handle text(valid(H5Tcopy(H5T_C_S1)), H5Tclose);
      H5Tset_size(text.id(), pick(random, 3) == 0 ? H5T_VARIABLE : 1 + pick(random, 20));
      return text;
    }

    double extreme_number(RandomNumbers &random)
    {
      static const std::array<double, 12> numbers = {0.,
                                                     -1.,
                                                     1.,
                                                     1e9,
                                                     -1e9,
                                                     2147483647.,
                                                     -2147483648.,
                                                     1e308,
                                                     5e-324,
                                                     std::numeric_limits<double>::quiet_NaN(),
                                                     std::numeric_limits<double>::infinity(),
                                                     0.5};
      return pick_from(random, numbers);
    }

    std::vector<hsize_t> sizes_of(const hid_t space)
    {
      std::vector<hsize_t> sizes(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
      H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
      return sizes;
    }

    /// A dataset that claims more than its file holds: its chunks were never written.
    void claim_much(const hid_t file, const std::string &path, RandomNumbers &random)
    {
      std::vector<hsize_t> sizes(1 + pick(random, 2), hsize_t(1) << (10 + pick(random, 20))), chunk(sizes.size(), 64);
      const Hdf5Handle     space(valid(H5Screate_simple(int(sizes.size()), sizes.data(), nullptr)), H5Sclose);
      const Hdf5Handle     layout(valid(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
      H5Pset_chunk(layout.id(), static_cast<int>(chunk.size()), chunk.data());
      const hid_t type = pick(random, 2) == 0 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT;
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      const Hdf5Handle data(
          valid(H5Dcreate2(file, path.c_str(), type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT)), H5Dclose);
    }

    void change_shape_or_kind(const hid_t file, const std::string &path, RandomNumbers &random)
    {
      std::vector<hsize_t> sizes;
      hid_t                before = H5T_NATIVE_DOUBLE;
      {
        const Hdf5Handle data(valid(H5Dopen2(file, path.c_str(), H5P_DEFAULT)), H5Dclose);
        const Hdf5Handle space(valid(H5Dget_space(data.id())), H5Sclose), type(H5Dget_type(data.id()), H5Tclose);
        sizes  = sizes_of(space.id());
        before = H5Tget_class(type.id()) == H5T_INTEGER ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
      }
      const Hdf5Handle space = random_space(sizes, random), type = random_type(before, random);
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      const Hdf5Handle data(
          valid(H5Dcreate2(file, path.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
          H5Dclose);
      if (H5Tget_class(type.id()) == H5T_STRING)
        return;
      std::vector<double> values(
          static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
      for (double &value : values)
        value = double(pick(random, 7));
      H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }

    void change_numbers(const hid_t file, const std::string &path, RandomNumbers &random)
    {
      const Hdf5Handle data(valid(H5Dopen2(file, path.c_str(), H5P_DEFAULT)), H5Dclose);
      const Hdf5Handle space(valid(H5Dget_space(data.id())), H5Sclose), type(H5Dget_type(data.id()), H5Tclose);
      const hssize_t   n = H5Sget_simple_extent_npoints(space.id());
      if (H5Tget_class(type.id()) == H5T_STRING || n <= 0)
        return;
      std::vector<double> values(static_cast<std::size_t>(n));
      H5Dread(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      for (std::size_t k = 1 + pick(random, 3); k > 0; --k)
        pick_from(random, values) = extreme_number(random);
      H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }

    void change_attribute(const hid_t object, RandomNumbers &random)
    {
      const std::vector<std::string> names = attributes_of(object);
      if (names.empty())
        return;
      const std::string &name   = pick_from(random, names);
      hid_t              before = H5T_NATIVE_DOUBLE;
      H5Adelete(object, name.c_str());
      if (pick(random, 4) == 0)
        return;
      const bool       is_single = pick(random, 2) == 0;
      const Hdf5Handle space     = is_single ? Hdf5Handle(valid(H5Screate(H5S_SCALAR)), H5Sclose)
                                             : random_space({1 + pick(random, 400)}, random),
                       type = is_single ? Hdf5Handle(valid(H5Tcopy(before)), H5Tclose) : random_type(before, random);
      const Hdf5Handle attribute(
          valid(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT)), H5Aclose);
      if (H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) > 0)
        return;
      if (H5Tget_class(type.id()) == H5T_STRING)
      {
        const std::string text(
            H5Tget_size(type.id()) * std::size_t(std::max<hssize_t>(1, H5Sget_simple_extent_npoints(space.id()))), 'x');
        H5Awrite(attribute.id(), type.id(), text.data());
        return;
      }
      std::vector<double> values(
          static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
      for (double &value : values)
        value = extreme_number(random);
      H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
    }

    bool is_dataset(const hid_t file, const std::string &path)
    {
      const Hdf5Handle object(valid(H5Oopen(file, path.c_str(), H5P_DEFAULT)), H5Oclose);
      return H5Iget_type(object.id()) == H5I_DATASET;
    }

    void change_object(const hid_t file, RandomNumbers &random)
    {
      const std::vector<std::string> objects = objects_in(file);
      const std::string              path    = "/" + pick_from(random, objects);
      const std::size_t              kind    = pick(random, 10);
      if (kind == 0 && objects.size() > 1)
        H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      else if (kind < 3 || !is_dataset(file, path))
      {
        const Hdf5Handle object(valid(H5Oopen(file, kind == 1 ? "/" : path.c_str(), H5P_DEFAULT)), H5Oclose);
        change_attribute(object.id(), random);
      }
      else if (kind == 3)
        claim_much(file, path, random);
      else if (kind < 7)
        change_shape_or_kind(file, path, random);
      else
        change_numbers(file, path, random);
    }
  } // namespace

  void mutate_hdf5(const std::filesystem::path &file, RandomNumbers &random)
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Hdf5Handle id(valid(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)), H5Fclose);
    for (std::size_t n = 1 + pick(random, 3); n > 0; --n)
      change_object(id.id(), random);
  }
} // namespace swimtwin
