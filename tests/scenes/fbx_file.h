#pragma once

#include <string>

namespace bumper::tests {

/// The axes and the unit that an FBX file states: 0, 1, 2 for x, y, z, with signs.
struct FbxSettings {
  int up = 1;
  int upSign = 1;
  double unit = 1.0;  ///< cm
  int front = 2;
  int frontSign = 1;
  int side = 0;
};

/// An FBX file in ASCII with one triangle, "fence", from the origin 300 along x and 100 along z.
inline std::string fbxFile(const FbxSettings& settings) {
  const auto property = [](const std::string& name, const std::string& type, const std::string& v) {
    return "    P: \"" + name + "\", \"" + type + "\", \"\", \"\"," + v + "\n";
  };
  return "; FBX 7.4.0 project file\n"
         "FBXHeaderExtension:  {\n  FBXHeaderVersion: 1003\n  FBXVersion: 7400\n}\n"
         "GlobalSettings:  {\n  Version: 1000\n  Properties70:  {\n" +
         property("UpAxis", "int", std::to_string(settings.up)) +
         property("UpAxisSign", "int", std::to_string(settings.upSign)) +
         property("FrontAxis", "int", std::to_string(settings.front)) +
         property("FrontAxisSign", "int", std::to_string(settings.frontSign)) +
         property("CoordAxis", "int", std::to_string(settings.side)) +
         property("CoordAxisSign", "int", "1") +
         property("UnitScaleFactor", "double", std::to_string(settings.unit)) +
         "  }\n}\n"
         "Objects:  {\n"
         "  Geometry: 11, \"Geometry::fence\", \"Mesh\" {\n"
         "    Vertices: *9 {\n      a: 0,0,0,300,0,0,0,0,100\n    }\n"
         "    PolygonVertexIndex: *3 {\n      a: 0,1,-3\n    }\n"
         "    GeometryVersion: 124\n  }\n"
         "  Model: 12, \"Model::fence\", \"Mesh\" {\n    Version: 232\n  }\n}\n"
         "Connections:  {\n  C: \"OO\",12,0\n  C: \"OO\",11,12\n}\n";
}

}  // namespace bumper::tests
