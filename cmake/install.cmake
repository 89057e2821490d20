# Installs the library with its public headers, so that find_package(Talus) gives talus::talus.
include(CMakePackageConfigHelpers)

set(public_headers
  base/angle.h base/describe.h base/error.h base/hash.h base/image.h base/job.h base/parallel.h base/stage.h
  base/suggest.h base/vec.h base/view_params.h
  mesh/check.h mesh/creases.h mesh/grid_bits.h mesh/instance_table.h mesh/polygon.h
  mesh/polygonize.h
  mesh/shape_measures.h mesh/triangle_mesh.h
  field/formula.h field/formula_program.h field/gradient_noise.h field/height_grid.h
  field/height_interval.h
  field/joined_support.h field/mesh_support.h field/patterns.h field/profile_curve.h field/shape.h
  field/shape_fields.h
  field/support.h field/swept_tube.h
  terrain/field_sampler.h terrain/ground_mesh.h terrain/layer_support.h terrain/layered_terrain.h
  terrain/ledger.h terrain/material.h terrain/terrain_field.h terrain/visible_shares.h
  terrain/water_surface.h
  settle/layer_order.h
  tools/brush.h tools/cover.h tools/deposit.h tools/erode_surface.h tools/fill_mesh.h
  tools/fill_support.h tools/noise_terrain.h tools/sculpt.h tools/set_surface.h tools/stroke.h
  tools/sweep.h
  rocks/stone_statistics.h rocks/tile_params.h rocks/tile_set.h
  piles/cube_bits.h piles/pile.h piles/pile_check.h piles/pile_control.h piles/pile_edits.h
  piles/pile_params.h piles/pile_support.h piles/section.h piles/specimens.h piles/tiling.h
  scatter/grading.h scatter/make_plots.h scatter/plot_params.h scatter/plots.h scatter/thin_plots.h
  io/atomic_file.h io/digest.h io/glb_writer.h io/image_reader.h io/inspect.h io/mask_reader.h io/mesh_reader.h
  io/mesh_writer.h io/png.h io/raster_reader.h io/scene_reader.h io/scene_view.h
  io/stone_table_writer.h io/tile_set_file.h io/usda_writer.h
  scene/build.h scene/document.h scene/fields.h scene/operation.h scene/output_params.h
  scene/outputs.h scene/pile_fields.h scene/recipe.h scene/report.h scene/support_source.h
  scene/surface_params.h scene/terrain_fields.h
  scene/tile_fields.h scene/tile_report.h
  render/picture.h render/render_scene.h)
list(TRANSFORM public_headers PREPEND ${PROJECT_SOURCE_DIR}/talus/)
target_sources(talus PUBLIC
  FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${public_headers})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Talus)
install(TARGETS talus EXPORT TalusTargets FILE_SET HEADERS)
install(EXPORT TalusTargets NAMESPACE talus:: DESTINATION ${package_dir})

configure_package_config_file(cmake/TalusConfig.cmake.in ${PROJECT_BINARY_DIR}/TalusConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TalusConfig.cmake ${PROJECT_BINARY_DIR}/TalusConfigVersion.cmake
        DESTINATION ${package_dir})
