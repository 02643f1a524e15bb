"""What people press and are asked: operators by feature."""
