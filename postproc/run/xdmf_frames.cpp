// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/xdmf_frames.hpp"

#include <hdf5.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "solver/base/error.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// An open HDF5 object.
class Object {
 public:
  Object(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier in HDF5's calls
  bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// What the index says about a frame.
struct Entry {
  double time = 0;
  std::string group;                          ///< in the HDF5 file
  std::map<std::string, std::string> arrays;  ///< path in the file, by name
  std::vector<FieldInfo> fields;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

int components_of(vtkXMLDataElement& item) {
  const std::string size = item.GetAttribute("Dimensions") ? item.GetAttribute("Dimensions") : "";
  const std::size_t blank = size.rfind(' ');
  return blank == std::string::npos ? 1 : std::atoi(size.c_str() + blank + 1);
}

Entry read_entry(vtkXMLDataElement& grid) {
  Entry entry;
  for (int i = 0; i < grid.GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement& part = *grid.GetNestedElement(i);
    const std::string kind = part.GetName();
    if (kind == "Time") part.GetScalarAttribute("Value", entry.time);
    if (kind != "Attribute" || part.GetNumberOfNestedElements() == 0) continue;
    vtkXMLDataElement& item = *part.GetNestedElement(0);
    const std::string name = part.GetAttribute("Name") ? part.GetAttribute("Name") : "";
    const std::string place = trimmed(item.GetCharacterData() ? item.GetCharacterData() : "");
    const std::size_t colon = place.find(':');
    if (name.empty() || colon == std::string::npos) continue;
    entry.arrays[name] = place.substr(colon + 1);
    entry.group = entry.arrays[name].substr(0, entry.arrays[name].rfind('/'));
    if (name != "id" && name != "material" && name != "body" && name != "position") {
      entry.fields.push_back({name, components_of(item)});
    }
  }
  return entry;
}

class XdmfFrames : public FrameSource {
 public:
  explicit XdmfFrames(const fs::path& folder) : file_(folder / "particles.h5") {
    const fs::path index = folder / "particles.xdmf";
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
        vtkXMLUtilities::ReadElementFromFile(index.c_str()));
    vtkXMLDataElement* domain = root ? root->FindNestedElementWithName("Domain") : nullptr;
    vtkXMLDataElement* series = domain ? domain->FindNestedElementWithName("Grid") : nullptr;
    if (series == nullptr) throw UserError(index.string() + " cannot be read");
    for (int i = 0; i < series->GetNumberOfNestedElements(); ++i) {
      entries_.push_back(read_entry(*series->GetNestedElement(i)));
      times_.push_back(entries_.back().time);
    }
    if (times_.empty()) throw UserError(index.string() + " lists no frame yet");
  }

  const std::vector<double>& times() const override { return times_; }
  std::vector<FieldInfo> fields(std::size_t frame) const override { return entries_[frame].fields; }

  ParticleSnapshot read(std::size_t frame, const std::vector<std::string>& fields) const override {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    // A run may go on meanwhile; what the index names is complete, so no lock is needed.
    const Object access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
    H5Pset_file_locking(access, false, true);
    const Object file(H5Fopen(file_.c_str(), H5F_ACC_RDONLY, access), &H5Fclose);
    if (!file.good()) throw UserError(file_.string() + " cannot be read");
    const Entry& entry = entries_[frame];
    ParticleSnapshot result;
    result.time = entry.time;
    read_array(file, entry, "position", H5T_NATIVE_DOUBLE, result.position);
    read_array(file, entry, "id", H5T_NATIVE_INT64, result.id);
    read_array(file, entry, "material", H5T_NATIVE_INT32, result.material);
    read_array(file, entry, "body", H5T_NATIVE_INT32, result.body);
    for (const std::string& name : fields) {
      const auto info = std::find_if(entry.fields.begin(), entry.fields.end(),
                                     [&](const FieldInfo& field) { return field.name == name; });
      if (info == entry.fields.end()) throw UserError(file_.string() + " has no field " + name);
      result.fields.push_back({name, "", info->components, {}});
      read_array(file, entry, name, H5T_NATIVE_DOUBLE, result.fields.back().values);
    }
    const Object step(H5Aopen_by_name(file, entry.group.c_str(), "step", H5P_DEFAULT, H5P_DEFAULT),
                      &H5Aclose);
    if (step.good()) H5Aread(step, H5T_NATIVE_INT64, &result.step);
    return result;
  }

 private:
  template <class T>
  void read_array(hid_t file, const Entry& entry, const std::string& name, hid_t type,
                  std::vector<T>& out) const {
    const auto path = entry.arrays.find(name);
    if (path == entry.arrays.end()) throw UserError("particles.xdmf names no array " + name);
    const Object set(H5Dopen2(file, path->second.c_str(), H5P_DEFAULT), &H5Dclose);
    const Object space(set.good() ? H5Dget_space(set) : -1, &H5Sclose);
    const hssize_t count = space.good() ? H5Sget_simple_extent_npoints(space) : -1;
    if (count >= 0) out.resize(static_cast<std::size_t>(count));
    if (count < 0 ||
        (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0)) {
      throw UserError(file_.string() + ": " + path->second + " cannot be read");
    }
  }

  fs::path file_;
  std::vector<double> times_;
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<FrameSource> open_xdmf_frames(const fs::path& folder) {
  return std::make_unique<XdmfFrames>(folder);
}

}  // namespace scree
