// SPDX-License-Identifier: Apache-2.0
#include "solver/io/vtk_frame.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/to_float.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

vtkSmartPointer<vtkDataArray> floating_array(const double* values, std::size_t count,
                                             int components, FramePrecision precision) {
  const auto tuples = static_cast<vtkIdType>(count / static_cast<std::size_t>(components));
  if (precision == FramePrecision::single_) {
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    std::transform(values, values + count, array->GetPointer(0), to_float);
    return array;
  }
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::copy_n(values, count, array->GetPointer(0));
  return array;
}

void name_components(vtkDataArray& array) {
  static constexpr std::array<const char*, 3> vector = {"X", "Y", "Z"};
  static constexpr std::array<const char*, 9> tensor = {"XX", "XY", "XZ", "YX", "YY",
                                                        "YZ", "ZX", "ZY", "ZZ"};
  const int components = array.GetNumberOfComponents();
  for (int c = 0; c < components; ++c) {
    if (components == 3) array.SetComponentName(c, vector[static_cast<std::size_t>(c)]);
    if (components == 9) array.SetComponentName(c, tensor[static_cast<std::size_t>(c)]);
  }
}

void add_fields(vtkPointData& data, const std::vector<SnapshotField>& fields, std::size_t points,
                FramePrecision precision) {
  for (const SnapshotField& field : fields) {
    if (field.values.size() != points * static_cast<std::size_t>(field.components)) {
      throw std::logic_error("field " + field.name + " does not fit the number of points");
    }
    const auto array =
        floating_array(field.values.data(), field.values.size(), field.components, precision);
    array->SetName(field.name.c_str());
    name_components(*array);
    data.AddArray(array);
    // What a viewer offers first as arrows.
    if (field.name == "velocity" && field.components == 3) data.SetActiveVectors("velocity");
  }
}

template <class Array, class T>
void add_integers(vtkPointData& data, const char* name, const std::vector<T>& values,
                  std::size_t points) {
  if (values.size() != points) {
    throw std::logic_error(std::string(name) + " does not fit the number of points");
  }
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data.AddArray(array);
}

void add_time(vtkFieldData& data, double time, std::int64_t step) {
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  data.AddArray(time_value);
  vtkNew<vtkTypeInt64Array> step_value;
  step_value->SetName("step");
  step_value->InsertNextValue(step);
  data.AddArray(step_value);
}

/// One vertex a point; 32-bit indices as long as they suffice.
template <class Array>
vtkSmartPointer<vtkCellArray> vertices(vtkIdType count) {
  vtkNew<Array> offsets;
  vtkNew<Array> points;
  offsets->SetNumberOfTuples(count + 1);
  points->SetNumberOfTuples(count);
  std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + count + 1, 0);
  std::iota(points->GetPointer(0), points->GetPointer(0) + count, 0);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, points);
  return cells;
}

bool ends_with_closing_tag(const fs::path& path) {
  constexpr std::string_view tag = "</VTKFile>\n";
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() < static_cast<std::streamoff>(tag.size())) return false;
  in.seekg(-static_cast<std::streamoff>(tag.size()), std::ios::end);
  std::string tail(tag.size(), '\0');
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return in && tail == tag;
}

/// More than the file of this data will have: base64 makes 4 bytes of 3, and 17 bytes describe a
/// cell.
std::int64_t largest_size(vtkDataSet& data) {
  constexpr std::int64_t head = 1024, tag = 400;  // text around all arrays, around one
  std::int64_t size = head + 3 * tag + 17 * data.GetNumberOfCells() * 4 / 3;
  const auto add = [&](vtkDataArray* array) {
    if (array == nullptr) return;
    const std::int64_t bytes =
        std::int64_t(array->GetNumberOfValues()) * std::int64_t(array->GetDataTypeSize());
    size += tag + (bytes + 8) * 4 / 3;  // 8: its length
  };
  vtkFieldData* const groups[] = {data.GetPointData(), data.GetFieldData()};
  for (vtkFieldData* group : groups) {
    for (int i = 0; i < group->GetNumberOfArrays(); ++i) add(group->GetArray(i));
  }
  if (auto* const points = vtkPointSet::SafeDownCast(&data)) add(points->GetPoints()->GetData());
  return size;
}

/// 0, or the error number that says why the disk has no room for a file of this size. VTK 9.1
/// crashes when it cannot write a file with arrays in place, so this is asked first.
int find_room(const fs::path& path, std::int64_t bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int error = posix_fallocate(file, 0, bytes);
  // File systems that cannot reserve have to be tried.
  if (error == EOPNOTSUPP || error == EINVAL) error = 0;
  return close(file) == 0 ? error : errno;
}

void write_aside_and_rename(vtkXMLWriter& writer, vtkDataSet& data, const fs::path& path) {
  const fs::path temporary = aside(path);
  // VTK's words are for programmers: an observer keeps them off the terminal.
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer.AddObserver("ErrorEvent", silence);
  writer.GetExecutive()->AddObserver("ErrorEvent", silence);
  writer.SetFileName(temporary.c_str());
  writer.SetInputDataObject(&data);
  // Arrays in place, base64. Appended ones are a quarter smaller, but the ParaView of an updated
  // Debian 12 cannot read them: libexpat 2.5.0-1+deb12u2 parses ahead into data that is not XML.
  writer.SetDataModeToBinary();
  writer.SetCompressorTypeToNone();
  writer.SetHeaderTypeToUInt64();
  errno = find_room(temporary, largest_size(data));
  const int written = errno == 0 ? writer.Write() : 0;
  const int error = errno;
  if (written == 0 || writer.GetErrorCode() != 0 || !ends_with_closing_tag(temporary)) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw RunFault(write_failure(path, error));
  }
  take_name(temporary, path);
}

}  // namespace

void write_particle_frame(const fs::path& path, const ParticleSnapshot& snapshot,
                          FramePrecision precision) {
  const std::size_t count = snapshot.id.size();
  if (snapshot.position.size() != 3 * count) {
    throw std::logic_error("positions do not fit the number of particles");
  }
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  // In single precision coordinates of a map, 4e6 m, would be rounded to half a metre.
  points->SetData(floating_array(snapshot.position.data(), 3 * count, 3, FramePrecision::double_));
  grid->SetPoints(points);
  const auto cells = static_cast<vtkIdType>(count);
  grid->SetCells(VTK_VERTEX, cells < std::numeric_limits<std::int32_t>::max()
                                 ? vertices<vtkTypeInt32Array>(cells)
                                 : vertices<vtkTypeInt64Array>(cells));
  add_integers<vtkTypeInt64Array>(*grid->GetPointData(), "id", snapshot.id, count);
  add_integers<vtkTypeInt32Array>(*grid->GetPointData(), "material", snapshot.material, count);
  add_integers<vtkTypeInt32Array>(*grid->GetPointData(), "body", snapshot.body, count);
  add_fields(*grid->GetPointData(), snapshot.fields, count, precision);
  add_time(*grid->GetFieldData(), snapshot.time, snapshot.step);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_aside_and_rename(*writer, *grid, path);
}

void write_grid_frame(const fs::path& path, const GridSnapshot& snapshot,
                      FramePrecision precision) {
  vtkNew<vtkImageData> image;
  image->SetOrigin(snapshot.origin[0], snapshot.origin[1], snapshot.origin[2]);
  image->SetSpacing(snapshot.spacing, snapshot.spacing, snapshot.spacing);
  image->SetDimensions(static_cast<int>(snapshot.nodes[0]), static_cast<int>(snapshot.nodes[1]),
                       static_cast<int>(snapshot.nodes[2]));
  const auto nodes = static_cast<std::size_t>(image->GetNumberOfPoints());
  add_fields(*image->GetPointData(), snapshot.fields, nodes, precision);
  add_time(*image->GetFieldData(), snapshot.time, snapshot.step);
  vtkNew<vtkXMLImageDataWriter> writer;
  write_aside_and_rename(*writer, *image, path);
}

}  // namespace scree
