# A Debian package of the programs, their data and the scripts that run them:
#   cmake --build --preset release --target package

set(SCRIPTS_DIR ${CMAKE_INSTALL_DATADIR}/nao-remote/scripts)
install(PROGRAMS scripts/start scripts/stop scripts/status scripts/spy scripts/record scripts/replay
                 scripts/setup
        DESTINATION ${SCRIPTS_DIR})
install(FILES scripts/imported_model.py scripts/output_file.py scripts/start.py scripts/stack.py scripts/robots.py scripts/seat.py scripts/lib.sh scripts/stack.sh scripts/packages
        DESTINATION ${SCRIPTS_DIR})
install(PROGRAMS packaging/nao-remote DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES packaging/nao-remote@.service packaging/nao-remote.target
        DESTINATION lib/systemd/user)
install(FILES packaging/nao-relay.service DESTINATION lib/systemd/system)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/nao-remote RENAME copyright)
install(FILES ${NAO_DATA_DIR}/lcmtypes.jar DESTINATION ${CMAKE_INSTALL_DATADIR}/nao-remote OPTIONAL)

# What the programs link to, dpkg-shlibdeps finds; what the scripts call is listed.
file(STRINGS scripts/packages RUN_PACKAGES REGEX "^run ")
list(TRANSFORM RUN_PACKAGES REPLACE "^run +([^ ]+).*" "\\1")
list(JOIN RUN_PACKAGES ", " RUN_DEPENDS)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nao-remote)
set(CPACK_PACKAGE_CONTACT "nao-remote maintainers <maintainers@nao-remote.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Drive a simulated NAO humanoid from any phone")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "bash, ${RUN_DEPENDS}")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "avahi-daemon, python3-zeroconf, default-jre, liblcm-java, libjchart2d-java")
include(CPack)
