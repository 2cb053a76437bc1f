# The page.
FROM debian:bookworm-slim AS web
# Only where npm sits behind a certificate authority of its own: a file with that authority's certificate.
ARG NPM_CONFIG_CAFILE
WORKDIR /src
COPY server/install server/packages.txt server/
RUN server/install web
COPY web_viewer/package.json web_viewer/package-lock.json web_viewer/
# Packages of the page have optional peers, of 120 MB, that it does not use.
RUN cd web_viewer && npm ci --omit=dev --legacy-peer-deps --no-audit --no-fund
COPY web_viewer web_viewer
RUN cd web_viewer && npm run build

# The server.
FROM debian:bookworm-slim AS build
WORKDIR /src
COPY server/install server/packages.txt server/
RUN server/install build
COPY CMakeLists.txt CMakePresets.json ./
COPY core core
COPY api api
COPY server server
RUN cmake --preset release -DSPOREPRINT_TESTS=OFF \
    && cmake --build build/release --target sporeprint \
    && strip build/release/server/sporeprint

# What runs: the server, its libraries, the page. No shell tool is needed, nothing is written.
FROM debian:bookworm-slim
COPY server/install server/packages.txt /tmp/server/
RUN /tmp/server/install run && rm -rf /tmp/server /var/lib/apt/lists/* /var/cache/apt/*.bin /var/log/apt /var/log/dpkg.log
COPY --from=build /src/build/release/server/sporeprint /usr/local/bin/sporeprint
COPY --from=web /src/web_viewer/dist /usr/share/sporeprint/web_viewer
ENV SPOREPRINT_HOST=0.0.0.0 SPOREPRINT_PORT=8080 SPOREPRINT_ASSETS=/usr/share/sporeprint/web_viewer
USER 10001:10001
EXPOSE 8080
STOPSIGNAL SIGTERM
HEALTHCHECK --interval=10s --timeout=3s --start-period=10s \
    CMD ["/usr/local/bin/sporeprint", "--health", "http://127.0.0.1:8080/livez"]
ENTRYPOINT ["/usr/local/bin/sporeprint"]
