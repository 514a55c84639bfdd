// SPDX-License-Identifier: Apache-2.0
#include "postproc/run/vtu_frames.hpp"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <set>

#include "solver/base/error.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> always_there = {"id", "material", "body"};

/// Reads one file; VTK's own messages are replaced by exceptions.
class VtuFile {
 public:
  explicit VtuFile(const fs::path& path) : path_(path) {
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&failed_);
    note->SetCallback(
        [](vtkObject*, unsigned long, void* failed, void*) { *static_cast<bool*>(failed) = true; });
    reader_->AddObserver("ErrorEvent", note);
    reader_->SetReaderErrorObserver(note);
    reader_->SetParserErrorObserver(note);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
      throw UserError(path.string() +
                      " is listed in particles.pvd but not there; a run that is being resumed "
                      "removes later frames: try again");
    }
    reader_->SetFileName(path.c_str());
    reader_->UpdateInformation();
    check();
  }

  vtkDataArraySelection& arrays() { return *reader_->GetPointDataArraySelection(); }

  vtkUnstructuredGrid& data() {
    reader_->Update();
    check();
    return *reader_->GetOutput();
  }

 private:
  void check() const {
    if (failed_) throw UserError(path_.string() + " cannot be read: it is damaged or no VTU file");
  }

  fs::path path_;
  bool failed_ = false;
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

vtkDataArray& array_of(vtkUnstructuredGrid& grid, const std::string& name, const fs::path& path) {
  vtkDataArray* array = grid.GetPointData()->GetArray(name.c_str());
  if (array == nullptr) throw UserError(path.string() + " has no field " + name);
  return *array;
}

void copy_values(vtkDataArray& array, std::vector<double>& out) {
  const int components = array.GetNumberOfComponents();
  out.resize(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    array.GetTuple(i, &out[static_cast<std::size_t>(i) * static_cast<std::size_t>(components)]);
  }
}

template <class T>
void copy_integers(vtkDataArray& array, std::vector<T>& out) {
  out.resize(static_cast<std::size_t>(array.GetNumberOfTuples()));
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    // Ids are below 2^53, so a double holds them.
    out[static_cast<std::size_t>(i)] = static_cast<T>(array.GetComponent(i, 0));
  }
}

double field_datum(vtkUnstructuredGrid& grid, const char* name, double otherwise) {
  vtkDataArray* array = grid.GetFieldData()->GetArray(name);
  return array != nullptr && array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : otherwise;
}

class VtuFrames : public FrameSource {
 public:
  explicit VtuFrames(const fs::path& folder) {
    const fs::path list = folder / "particles.pvd";
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
        vtkXMLUtilities::ReadElementFromFile(list.c_str()));
    vtkXMLDataElement* sets = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (sets == nullptr) throw UserError(list.string() + " cannot be read");
    for (int i = 0; i < sets->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement& item = *sets->GetNestedElement(i);
      double time = 0;
      const char* file = item.GetAttribute("file");
      if (file == nullptr || item.GetScalarAttribute("timestep", time) == 0) continue;
      times_.push_back(time);
      files_.push_back(folder / file);
    }
    if (times_.empty()) throw UserError(list.string() + " lists no frame yet");
  }

  const std::vector<double>& times() const override { return times_; }

  std::vector<FieldInfo> fields(std::size_t frame) const override {
    VtuFile file(files_[frame]);
    // Components are known after reading only.
    vtkUnstructuredGrid& grid = file.data();
    std::vector<FieldInfo> result;
    for (int i = 0; i < grid.GetPointData()->GetNumberOfArrays(); ++i) {
      vtkDataArray* array = grid.GetPointData()->GetArray(i);
      if (array == nullptr || always_there.count(array->GetName()) > 0) continue;
      result.push_back({array->GetName(), array->GetNumberOfComponents()});
    }
    return result;
  }

  ParticleSnapshot read(std::size_t frame, const std::vector<std::string>& fields) const override {
    const fs::path& path = files_[frame];
    VtuFile file(path);
    for (int i = 0; i < file.arrays().GetNumberOfArrays(); ++i) {
      const std::string name = file.arrays().GetArrayName(i);
      const bool wanted = always_there.count(name) > 0 ||
                          std::find(fields.begin(), fields.end(), name) != fields.end();
      if (!wanted) file.arrays().DisableArray(name.c_str());
    }
    vtkUnstructuredGrid& grid = file.data();
    ParticleSnapshot result;
    result.time = field_datum(grid, "TimeValue", times_[frame]);
    result.step = static_cast<std::int64_t>(field_datum(grid, "step", 0));
    copy_integers(array_of(grid, "id", path), result.id);
    copy_integers(array_of(grid, "material", path), result.material);
    copy_integers(array_of(grid, "body", path), result.body);
    if (grid.GetNumberOfPoints() > 0) copy_values(*grid.GetPoints()->GetData(), result.position);
    for (const std::string& name : fields) {
      vtkDataArray& array = array_of(grid, name, path);
      result.fields.push_back({name, "", array.GetNumberOfComponents(), {}});
      copy_values(array, result.fields.back().values);
    }
    return result;
  }

 private:
  std::vector<double> times_;
  std::vector<fs::path> files_;
};

}  // namespace

std::unique_ptr<FrameSource> open_vtu_frames(const fs::path& folder) {
  return std::make_unique<VtuFrames>(folder);
}

}  // namespace scree
